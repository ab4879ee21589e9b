// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/support/child.h"

#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scipd::tests {

Child::Child(const std::vector<std::string>& command, const std::string& input) {
    std::ofstream(directory_.path() / "in", std::ios::binary) << input;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const auto file = [&](int descriptor, const char* name, int flags) {
        const std::string path = directory_.path() / name;
        posix_spawn_file_actions_addopen(&files, descriptor, path.c_str(), flags, 0600);
    };
    file(STDIN_FILENO, "in", O_RDONLY);
    file(STDOUT_FILENO, "out", O_WRONLY | O_CREAT);
    file(STDERR_FILENO, "err", O_WRONLY | O_CREAT);

    std::vector<char*> arguments;
    for (const std::string& word : command)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int error = posix_spawn(&pid_, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw std::system_error(error, std::generic_category(), command.front());
}

Child::~Child() {
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
}

void Child::signal(int number) const {
    kill(pid_, number);
}

Outcome Child::wait() {
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(directory_.path() / "out"),
            read_file(directory_.path() / "err")};
}

Outcome run(const std::vector<std::string>& command, const std::string& input) {
    return Child(command, input).wait();
}

std::string read_file(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace scipd::tests
