// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/child_program.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

constexpr int no_program = 127;  // as shells have it
constexpr int ended_by_signal = 128;

int open_to_write(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor < 0) throw std::system_error(errno, std::generic_category(), file);
    return descriptor;
}

std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// In the child. Only what is safe after fork().
[[noreturn]] void become(char* const* command, pid_t parent, int output, int errors) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() == parent && ::dup2(output, STDOUT_FILENO) >= 0 &&
        ::dup2(errors, STDERR_FILENO) >= 0) {
        ::execv(command[0], command);
    }
    ::_exit(no_program);
}

}  // namespace

std::filesystem::path program_beside(const std::string& name) {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
}

ChildProgram::ChildProgram(const std::vector<std::string>& command,
                           const std::filesystem::path& directory, const std::string& name)
    : output_(directory / (name + ".out")), errors_(directory / (name + ".err")) {
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int output = open_to_write(output_);
    const int errors = open_to_write(errors_);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    const int error = errno;
    if (pid_ == 0) become(words.data(), parent, output, errors);
    ::close(output);
    ::close(errors);
    if (pid_ < 0) throw std::system_error(error, std::generic_category(), command.front());
}

ChildProgram::~ChildProgram() {
    constexpr auto patience = 10s;
    if (!exit_code()) ::kill(pid_, SIGTERM);
    const auto until = std::chrono::steady_clock::now() + patience;
    while (!exit_code() && std::chrono::steady_clock::now() < until)
        std::this_thread::sleep_for(1ms);
    if (exit_code()) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

std::optional<int> ChildProgram::exit_code() {
    int status = 0;
    if (!exit_code_ && ::waitpid(pid_, &status, WNOHANG) == pid_)
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : ended_by_signal + WTERMSIG(status);
    return exit_code_;
}

std::string ChildProgram::output() const {
    return content_of(output_);
}

std::string ChildProgram::errors() const {
    return content_of(errors_);
}

}  // namespace scipd::tools
