// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/kept_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing/scipd_values.h"

namespace scipd::testing {
namespace {

/// The process between a test and its scipd. It runs scipd as its child, ends it and removes its
/// folder when the test asks for that or is gone in whatever way: killed, timed out, or ended
/// without a word. So no scipd is ever looked for by its name, and none is left behind.
///
///   test ──fork──► keeper ──fork──► scipd
///     └─ messages ──┘ └─ PR_SET_PDEATHSIG ─┘
///
/// A signal for the death of a parent alone would not do: it comes when the thread that has forked
/// ends. The keeper is forked from a program with any threads, so it allocates nothing: all of its
/// orders is made before the fork.
struct KeeperOrders {
    const char* folder;        ///< absolute; removed at the end
    char* const* command;      ///< of scipd
    char* const* environment;  ///< of scipd
    /// A socket that keeps messages apart. The keeper tells an int, the number of scipd, and, when
    /// it has ended, another, its status as of waitpid(). Any message to it ends scipd; the end of
    /// the connection ends the keeper.
    int messages;
    int test;     ///< a descriptor of the process of the test, which can be read when it has ended
    int output;   ///< standard output of scipd
    int log;      ///< standard error of scipd
    int nothing;  ///< standard input of scipd
};

/// The forked process, to its end.
[[noreturn]] void keep(const KeeperOrders& orders) noexcept;

/// A descriptor that can be read when this process has ended; -1 before Linux 5.3.
[[nodiscard]] int open_process(int pid) noexcept;

// scipd ends within milliseconds. A sanitized one takes longer, and one that hangs is killed then.
constexpr int patience_ms = 15'000;

void tell(int messages, int what) noexcept {
    (void)::send(messages, &what, sizeof(what), MSG_NOSIGNAL);
}

/// A signal to the group of the tests, by a terminal or a runner, does not reach this process: it
/// must outlive them to end scipd. scipd does not inherit the signal handlers of the test.
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

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// The keeper itself kills what does not end before this is over.
constexpr std::chrono::seconds end_patience{30};
// A Unix socket has at most 107 bytes, and some runners have folders that are longer than that.
constexpr std::size_t longest_folder = 80;
// What a service manager says to the test is not said to its scipd.
constexpr std::array<std::string_view, 9> not_handed_on{
    "NOTIFY_SOCKET",  "WATCHDOG_USEC",  "WATCHDOG_PID",  "LISTEN_FDS",       "LISTEN_PID",
    "LISTEN_FDNAMES", "JOURNAL_STREAM", "INVOCATION_ID", "RUNTIME_DIRECTORY"};

int checked(int result, const char* what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

/// A descriptor that is closed at the end of the scope.
class Descriptor {
  public:
    Descriptor(int number, const char* what) : number_(checked(number, what)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }

    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] int release() { return std::exchange(number_, -1); }

  private:
    int number_;
};

std::filesystem::path new_folder() {
    std::string pattern = std::filesystem::temp_directory_path() / "scipd-XXXXXX";
    if (pattern.size() > longest_folder) pattern = "/tmp/scipd-XXXXXX";
    if (::mkdtemp(pattern.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), "a folder " + pattern);
    return pattern;
}

std::vector<std::string> environment_in(const std::filesystem::path& folder) {
    std::vector<std::string> environment{"RUNTIME_DIRECTORY=" + folder.string()};
    for (char** entry = ::environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        if (std::ranges::find(not_handed_on, text.substr(0, text.find('='))) == not_handed_on.end())
            environment.emplace_back(text);
    }
    return environment;
}

std::vector<char*> as_argv(const std::vector<std::string>& words) {
    std::vector<char*> argv;
    for (const std::string& word : words)
        argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    return argv;
}

bool can_be_read(int descriptor, milliseconds patience) {
    pollfd event{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&event, 1, static_cast<int>(patience.count())) > 0;
}

milliseconds left_until(steady_clock::time_point end) {
    return std::chrono::ceil<milliseconds>(std::max(end - steady_clock::now(), {}));
}

}  // namespace

KeptProcess::KeptProcess(const std::function<std::vector<std::string>(const Folder&)>& command_in)
    : folder_(new_folder()), owner_(::getpid()) {
    try {
        start(command_in(folder_));
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
        throw;
    }
    pid_ = hear(end_patience).value_or(-1);
}

void KeptProcess::start(const std::vector<std::string>& command) {
    std::array<int, 2> messages{};
    checked(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, messages.data()), "socketpair");
    Descriptor ours(messages[0], "socketpair");
    const Descriptor theirs(messages[1], "socketpair");
    std::array<int, 2> output{};
    checked(::pipe2(output.data(), O_CLOEXEC), "pipe2");
    Descriptor reading(output[0], "pipe2");
    const Descriptor writing(output[1], "pipe2");
    const std::string log_file = folder_ / "log";
    const Descriptor log(::open(log_file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600),
                         "the log");
    const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC), "/dev/null");
    const Descriptor test(open_process(owner_), "pidfd_open, which Linux has since 5.3");

    const auto environment = environment_in(folder_);
    const auto argv = as_argv(command);
    const auto envp = as_argv(environment);
    const KeeperOrders orders{.folder = folder_.c_str(),
                              .command = argv.data(),
                              .environment = envp.data(),
                              .messages = theirs.number(),
                              .test = test.number(),
                              .output = writing.number(),
                              .log = log.number(),
                              .nothing = nothing.number()};
    keeper_ = checked(::fork(), "fork");
    if (keeper_ == 0) keep(orders);
    messages_ = ours.release();
    output_ = reading.release();
}

std::string KeptProcess::first_line(milliseconds patience) const {
    const auto end = steady_clock::now() + patience;
    std::string line;
    std::array<char, 4096> buffer;
    while (line.find('\n') == line.npos) {
        if (!can_be_read(output_, left_until(end))) return {};
        const ssize_t count = ::read(output_, buffer.data(), buffer.size());
        if (count <= 0) return {};
        line.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return line.substr(0, line.find('\n'));
}

std::optional<int> KeptProcess::exit_code(milliseconds patience) {
    if (exit_code_ || messages_ < 0) return exit_code_;
    if (const auto status = hear(patience))
        exit_code_ = WIFEXITED(*status) ? WEXITSTATUS(*status) : -WTERMSIG(*status);
    return exit_code_;
}

/// The next message of the keeper. If it is gone, scipd has been killed with it.
std::optional<int> KeptProcess::hear(milliseconds patience) const {
    if (!can_be_read(messages_, patience)) return std::nullopt;
    int message = SIGKILL;
    (void)::recv(messages_, &message, sizeof(message), 0);
    return message;
}

std::string KeptProcess::log() const {
    if (messages_ < 0) return last_log_;
    std::ifstream file(folder_ / "log", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void KeptProcess::end() noexcept try {
    if (messages_ < 0 || ::getpid() != owner_) return;
    constexpr char word = 'e';
    if (!exit_code()) (void)::send(messages_, &word, sizeof(word), MSG_NOSIGNAL);
    (void)exit_code(end_patience);
    last_log_ = log();
    // The keeper removes the folder, and ends.
    ::close(std::exchange(messages_, -1));
    ::close(std::exchange(output_, -1));
    while (::waitpid(keeper_, nullptr, 0) < 0 && errno == EINTR) {
    }
} catch (const std::exception&) {
    // Without memory for the log there is none.
}

}  // namespace scipd::testing
