// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/daemon_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/control_request.h"
#include "tests/support/sanitized.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

// Far longer than scipd takes even on a busy machine.
constexpr auto patience = sanitized ? 120s : 20s;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("scipd " + what);
}

int checked(int result, const char* what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

struct Pipe {
    int read_end = -1;
    int write_end = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    checked(::pipe2(ends.data(), O_CLOEXEC), "pipe2");
    return {ends[0], ends[1]};
}

// A directory may hold several error files. None is overwritten.
std::filesystem::path new_error_file(const std::filesystem::path& directory) {
    std::string pattern = directory / "stderr-XXXXXX";
    ::close(checked(::mkostemp(pattern.data(), O_CLOEXEC), "mkostemp"));
    return pattern;
}

}  // namespace

std::filesystem::path scene(std::string_view file) {
    return std::filesystem::path(SCIPD_SCENES) / file;
}

bool can_draw() {
    const TempDir directory;
    DaemonProcess probe(directory, {"--probe"});
    probe.wait();
    return probe.standard_output().find("self-test   passed") != std::string::npos;
}

std::vector<std::string> all_models() {
    const TempDir directory;
    DaemonProcess list(directory, {"--list-models"});
    list.wait();
    std::istringstream lines(list.standard_output());
    std::vector<std::string> models;
    std::string line;
    std::getline(lines, line);  // the titles of the first table, which ends with an empty line
    while (std::getline(lines, line) && !line.empty())
        models.push_back(line.substr(0, line.find(' ')));
    return models;
}

DaemonProcess::DaemonProcess(const TempDir& directory, std::vector<std::string> arguments,
                             const StandardDescriptors& descriptors)
    : directory_(directory.path()), error_file_(new_error_file(directory_)) {
    arguments.insert(arguments.begin(), SCIPD_PROGRAM);
    start(arguments, descriptors);
    read_ready_line();
}

DaemonProcess::~DaemonProcess() {
    if (!exit_code_) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    ::close(input_);
    ::close(output_descriptor_);
}

void DaemonProcess::start(const std::vector<std::string>& arguments,
                          const StandardDescriptors& descriptors) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const Pipe input = make_pipe();
    const Pipe output = make_pipe();
    const int error = checked(::open(error_file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC), "open");
    const pid_t parent = ::getpid();
    ::setenv("XDG_RUNTIME_DIR", directory_.c_str(), 1);
    ::unsetenv("RUNTIME_DIRECTORY");

    pid_ = checked(::fork(), "fork");
    if (pid_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(126);
        ::dup2(input.read_end, STDIN_FILENO);
        ::dup2(output.write_end, STDOUT_FILENO);
        ::dup2(descriptors.error.value_or(error), STDERR_FILENO);
        for (const int descriptor : descriptors.closed)
            ::close(descriptor);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(input.read_end);
    ::close(output.write_end);
    ::close(error);
    input_ = input.write_end;
    output_descriptor_ = output.read_end;
}

void DaemonProcess::read_ready_line() {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (output_.find('\n') == std::string::npos) {
        if (std::chrono::steady_clock::now() > until) fail("does not get ready");
        if (!read_output(100ms)) return;
    }
    ready_line_ = output_.substr(0, output_.find('\n'));
}

/// Returns false if there will be no more output.
bool DaemonProcess::read_output(std::chrono::milliseconds timeout) {
    pollfd event{.fd = output_descriptor_, .events = POLLIN};
    if (::poll(&event, 1, static_cast<int>(timeout.count())) <= 0) return true;
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(output_descriptor_, buffer.data(), buffer.size());
    if (count <= 0) return false;
    output_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
}

nlohmann::json DaemonProcess::sensor(std::size_t index) const {
    return nlohmann::json::parse(ready_line_).at("sensors").at(index);
}

std::uint16_t DaemonProcess::port(std::size_t index) const {
    const auto address = sensor(index).at("tcp").get<std::string>();
    return static_cast<std::uint16_t>(std::stoul(address.substr(address.rfind(':') + 1)));
}

std::filesystem::path DaemonProcess::tty(std::size_t index) const {
    return sensor(index).at("pty").get<std::string>();
}

std::filesystem::path DaemonProcess::control() const {
    return nlohmann::json::parse(ready_line_).at("control").get<std::string>();
}

nlohmann::json DaemonProcess::get(const std::string& path) const {
    return control_get(control(), path);
}

nlohmann::json DaemonProcess::sensor_status(std::size_t index) const {
    return get("/status").at("sensors").at(index);
}

void DaemonProcess::say(std::string_view text) const {
    while (!text.empty()) {
        const ssize_t count = ::write(input_, text.data(), text.size());
        text.remove_prefix(
            static_cast<std::size_t>(checked(static_cast<int>(count), "standard input of scipd")));
    }
}

void DaemonProcess::signal(int number) const {
    checked(::kill(pid_, number), "kill");
}

int DaemonProcess::wait() {
    const auto until = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (!exit_code_ && checked(::waitpid(pid_, &status, WNOHANG), "waitpid") == 0) {
        if (std::chrono::steady_clock::now() > until) fail("does not end");
        std::this_thread::sleep_for(5ms);
    }
    if (!exit_code_) exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    while (read_output(0ms)) {
    }
    return *exit_code_;
}

std::string DaemonProcess::standard_error() const {
    std::ifstream file(error_file_);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace scipd::tests
