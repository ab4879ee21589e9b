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
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing/keeper.h"
#include "testing/scipd_values.h"

namespace scipd::testing {
namespace {

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
