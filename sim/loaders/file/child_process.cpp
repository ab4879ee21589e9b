// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/child_process.h"

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scipd::sim {
namespace {

std::string end_of(int status, const Confines& confines) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    // The soft limit of processor time sends SIGXCPU, the hard limit, which is the same, SIGKILL.
    if (signal == SIGXCPU || signal == SIGKILL) {
        return "takes more than " + std::to_string(confines.processor_time.count()) +
               " s of processor time, or all memory";
    }
    return "crashes the library that reads it" +
           (signal != 0 ? " (signal " + std::to_string(signal) + ")" : std::string{});
}

}  // namespace

/// The process ends with this object at the latest.
class ChildProcess::Process {
  public:
    /// Without process descriptors (pidfd), ends_within() notices an end only when its time is up.
    explicit Process(pid_t pid)
        : pid_(pid), descriptor_(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))) {}
    ~Process() {
        if (!ended_) kill();
        if (descriptor_ >= 0) close(descriptor_);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// False if the child still runs after this time.
    bool ends_within(std::chrono::milliseconds patience) {
        pollfd end{.fd = descriptor_, .events = POLLIN, .revents = 0};
        poll(&end, 1, static_cast<int>(patience.count()));
        reap(WNOHANG);
        return ended_;
    }

    void kill() {
        ::kill(pid_, SIGKILL);
        reap(0);
    }

    [[nodiscard]] int status() const { return status_; }

  private:
    void reap(int how) {
        pid_t reaped = -1;
        do
            reaped = waitpid(pid_, &status_, how);
        while (reaped < 0 && errno == EINTR);
        ended_ = reaped != 0;
        if (reaped < 0) status_ = -1;  // waitpid() failed
    }

    pid_t pid_;
    int descriptor_;
    int status_ = 0;
    bool ended_ = false;
};

ChildProcess::ChildProcess(Confines confines, std::unique_ptr<Shared> shared, pid_t pid)
    : confines_(std::move(confines)),
      deadline_(std::chrono::steady_clock::now() + confines_.wall_time),
      shared_(std::move(shared)),
      process_(std::make_unique<Process>(pid)) {}

ChildProcess::~ChildProcess() = default;

void ChildProcess::wait() {
    // How long a stop request can go unnoticed.
    constexpr std::chrono::milliseconds glance{20};
    while (!process_->ends_within(glance)) {
        if (confines_.stop.stop_requested()) throw std::runtime_error("was not read to its end");
        if (std::chrono::steady_clock::now() < deadline_) continue;
        process_->kill();
        throw std::runtime_error(too_late());
    }
}

std::string ChildProcess::too_late() const {
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(confines_.wall_time).count();
    const std::string doing = shared_->doing.last();
    return "was not read within " + std::to_string(seconds) + " s" +
           (doing.empty() ? "" : "; at last it was " + doing) +
           (confines_.more_time.empty() ? "; does it lie on a disk that does not answer?"
                                        : "; " + confines_.more_time);
}

File ChildProcess::outcome() {
    wait();
    // The child wrote through the same open file, so its position is shared too.
    std::rewind(shared_->answer.get());
    const int status = process_->status();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::move(shared_->answer);
    if (WIFEXITED(status) && WEXITSTATUS(status) == failed_with_words) {
        throw std::runtime_error(rest_of(shared_->answer.get()));
    }
    throw std::runtime_error(end_of(status, confines_));
}

std::string rest_of(std::FILE* file) {
    std::string text;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
        text.push_back(static_cast<char>(c));
    return text;
}

}  // namespace scipd::sim
