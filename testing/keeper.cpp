// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/keeper.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scipd::testing {
namespace {

// scipd ends within milliseconds. A sanitized one takes longer, and one that hangs is killed then.
constexpr int patience_ms = 15'000;

void tell(int messages, int what) noexcept {
    (void)::send(messages, &what, sizeof(what), MSG_NOSIGNAL);
}

/// What a terminal or a runner does to the group of the tests does not reach this process, so it is
/// there to end scipd when they are gone. What the test does with signals is not for scipd.
void leave_the_test() noexcept {
    ::setsid();
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD, SIGPIPE})
        ::signal(number, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Whatever else the test has open would stay open as long as this process lives.
void close_all_but(int one, int other) noexcept {
    const auto first = static_cast<unsigned>(std::min(one, other));
    const auto second = static_cast<unsigned>(std::max(one, other));
    constexpr unsigned lowest = STDERR_FILENO + 1;
    if (first > lowest) ::close_range(lowest, first - 1, 0);
    if (second > first + 1) ::close_range(first + 1, second - 1, 0);
    ::close_range(second + 1, ~0U, 0);
}

[[noreturn]] void run_scipd(const KeeperOrders& orders, pid_t keeper) noexcept {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != keeper) ::_exit(126);
    ::close(orders.messages);
    ::close(orders.test);
    ::execve(orders.command[0], orders.command, orders.environment);
    ::_exit(127);
}

/// scipd, while it runs and afterwards. Until it is reaped its number is nobody else's.
class Child {
  public:
    Child(pid_t pid, int messages) noexcept
        : pid_(pid), process_(open_process(pid)), messages_(messages) {}

    /// Can be read when it has ended; -1 from then on.
    [[nodiscard]] int process() const noexcept { return process_; }

    void reap() noexcept {
        int status = 0;
        if (process_ < 0) return;
        while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        ::close(process_);
        process_ = -1;
        tell(messages_, status);
    }

    void end() noexcept {
        if (process_ < 0) return;
        ::kill(pid_, SIGTERM);
        pollfd ended{.fd = process_, .events = POLLIN, .revents = 0};
        if (::poll(&ended, 1, patience_ms) <= 0) ::kill(pid_, SIGKILL);
        reap();
    }

  private:
    pid_t pid_;
    int process_;
    int messages_;
};

/// Until the test is gone.
void serve(const KeeperOrders& orders, Child& child) noexcept {
    for (;;) {
        std::array<pollfd, 3> events{
            {{orders.messages, POLLIN, 0}, {orders.test, POLLIN, 0}, {child.process(), POLLIN, 0}}};
        if (::poll(events.data(), events.size(), -1) < 0) continue;
        if (events[2].revents != 0) child.reap();
        if (events[1].revents != 0) return;
        if (events[0].revents != 0) {
            char word = 0;
            if (::recv(orders.messages, &word, sizeof(word), 0) <= 0) return;
            child.end();
        }
    }
}

}  // namespace

int open_process(int pid) noexcept {
    return static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
}

void keep(const KeeperOrders& orders) noexcept {
    leave_the_test();
    ::dup2(orders.nothing, STDIN_FILENO);
    ::dup2(orders.output, STDOUT_FILENO);
    ::dup2(orders.log, STDERR_FILENO);
    close_all_but(orders.messages, orders.test);
    const pid_t keeper = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) run_scipd(orders, keeper);
    // The line that scipd writes ends with scipd.
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    tell(orders.messages, pid);
    if (pid > 0) {
        Child child(pid, orders.messages);
        serve(orders, child);
        child.end();
    }
    // The folder goes last, and this process with it.
    ::execl("/bin/rm", "rm", "-rf", "--", orders.folder, nullptr);
    ::_exit(127);
}

}  // namespace scipd::testing
