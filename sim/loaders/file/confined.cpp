// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/confined.h"

#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/landlock.h"

namespace scipd::sim {
namespace {

constexpr int failed_with_words = 1;
/// The status by which a shell reports this.
constexpr int no_such_program = 127;
constexpr int cannot_be_held = 126;
/// Enough for a world of about so many models, each of which is a file.
constexpr rlim_t most_descriptors = 1024;

std::size_t memory_in_use() {
    std::size_t pages = 0;
    std::ifstream{"/proc/self/statm"} >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// A template, since the type of a resource differs between C libraries.
template <typename Resource>
void limit(Resource resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(resource, &both);
}

/// Closes all descriptors that the work does not need. Otherwise a connection or a port that the
/// parent closes meanwhile would stay open in the child.
void close_all_but(int kept) {
    if (kept > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, kept - 1, 0);
    close_range(kept + 1, ~0U, 0);
}

void enter(const Confines& confines, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(failed_with_words);  // it ended before the prctl()
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_DFL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_NOFILE, most_descriptors);
    limit(RLIMIT_CPU, static_cast<rlim_t>(confines.processor_time.count()));
    limit(RLIMIT_AS, memory_in_use() + confines.memory_bytes);
}

std::string advice(const std::string& what) {
    return what.empty() ? "" : "; " + what;
}

/// In the child: writes the answer or an error to the file; the exit status tells which.
[[noreturn]] void run(const Confines& confines, const std::function<void(std::FILE* out)>& work,
                      std::FILE* out, pid_t parent) {
    // Made now, while there is memory for it.
    const std::string too_much = "takes more than " +
                                 std::to_string(confines.memory_bytes / 1'000'000) +
                                 " MB of memory" + advice(confines.more_memory);
    const auto leave_with = [out](const char* words) {
        std::rewind(out);
        if (ftruncate(fileno(out), 0) == 0) std::fputs(words, out);
        std::fflush(out);
        _exit(failed_with_words);
    };
    try {
        close_all_but(fileno(out));
        enter(confines, parent);
        work(out);
        if (std::fflush(out) != 0) leave_with("there is no memory left for its result");
        _exit(0);
    } catch (const std::bad_alloc&) {
        leave_with(too_much.c_str());
    } catch (const std::exception& error) {
        leave_with(error.what());
    } catch (...) {
        leave_with("ended with an unknown error");
    }
    _exit(failed_with_words);
}

std::string all_of(std::FILE* file) {
    std::string text;
    for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
        text.push_back(static_cast<char>(c));
    return text;
}

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
class Confined::Child {
  public:
    /// Without process descriptors (pidfd), ends_within() notices an end only when its time is up.
    explicit Child(pid_t pid)
        : pid_(pid), descriptor_(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))) {}
    ~Child() {
        if (!ended_) kill();
        if (descriptor_ >= 0) close(descriptor_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

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

Confined::Confined(Confines confines, const std::function<void(std::FILE* out)>& work)
    : confines_(std::move(confines)),
      deadline_(std::chrono::steady_clock::now() + confines_.wall_time),
      file_(memory_file()) {
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid == 0) {
        doing_.begin();
        run(confines_, work, file_.get(), parent);
    }
    child_ = std::make_unique<Child>(pid);
}

Confined::~Confined() = default;

void Confined::wait() {
    // How long a stop request can go unnoticed.
    constexpr std::chrono::milliseconds glance{20};
    while (!child_->ends_within(glance)) {
        if (confines_.stop.stop_requested()) throw std::runtime_error("was not read to its end");
        if (std::chrono::steady_clock::now() < deadline_) continue;
        child_->kill();
        throw std::runtime_error(too_late());
    }
}

std::string Confined::too_late() const {
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(confines_.wall_time).count();
    const std::string doing = doing_.last();
    return "was not read within " + std::to_string(seconds) + " s" +
           (doing.empty() ? "" : "; at last it was " + doing) +
           (confines_.more_time.empty() ? "; does it lie on a disk that does not answer?"
                                        : advice(confines_.more_time));
}

File Confined::outcome() {
    wait();
    // The child wrote through the same open file, so its position is shared too.
    std::rewind(file_.get());
    const int status = child_->status();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::move(file_);
    if (WIFEXITED(status) && WEXITSTATUS(status) == failed_with_words) {
        throw std::runtime_error(all_of(file_.get()));
    }
    throw std::runtime_error(end_of(status, confines_));
}

namespace {

/// In a child of a confined child: becomes the program.
[[noreturn]] void become(const std::vector<std::string>& command, std::FILE* said,
                         std::FILE* told) {
    constexpr rlim_t most_output = 256U << 20U;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_FSIZE, most_output);
    const File nothing = memory_file();
    dup2(fileno(nothing.get()), STDIN_FILENO);
    dup2(fileno(said), STDOUT_FILENO);
    dup2(fileno(told), STDERR_FILENO);
    std::vector<char*> words;
    if (const Folders* folders = folders_to_read(); folders && !hold_program_to(*folders))
        _exit(cannot_be_held);
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execvp(words.front(), words.data());
    _exit(errno == ENOENT ? no_such_program : failed_with_words);
}

std::string from_its_beginning(std::FILE* file) {
    std::rewind(file);
    return all_of(file);
}

/// In a confined child.
void run_program(const std::vector<std::string>& command, std::FILE* out) {
    const File said = memory_file();
    const File told = memory_file();
    const pid_t pid = fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid == 0) become(command, said.get(), told.get());
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    const std::string words = from_its_beginning(told.get());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : failed_with_words;
    if (folders_to_read() != nullptr && code == cannot_be_held && words.empty()) {
        throw std::runtime_error(
            "this kernel has no Landlock, which would hold it to the folders that `allow` in the "
            "configuration names");
    }
    const bool is_there = code != no_such_program || !words.empty();
    if (code != 0 && is_there) {
        throw std::runtime_error(words.empty() ? "ends with " + std::to_string(code) : words);
    }
    put(is_there, out);
    put_all(from_its_beginning(said.get()), out);
}

}  // namespace

std::optional<std::string> output_of(const Confines& confines,
                                     const std::vector<std::string>& command) {
    const File answer = run_confined(confines, [&](std::FILE* out) { run_program(command, out); });
    const bool is_there = take<bool>(answer.get());
    auto text = take_all<std::string>(answer.get());
    if (!is_there) return std::nullopt;
    return text;
}

}  // namespace scipd::sim
