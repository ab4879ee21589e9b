// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/confined.h"

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/child_work.h"
#include "sim/loaders/file/landlock.h"

namespace scipd::sim {
namespace {

/// The status by which a shell reports this.
constexpr int no_such_program = 127;
constexpr int cannot_be_held = 126;

/// Closes all descriptors that the work does not need. Otherwise a connection or a port that the
/// parent closes meanwhile would stay open in the child.
void close_all_but(int kept) {
    if (kept > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, kept - 1, 0);
    close_range(kept + 1, ~0U, 0);
}

std::unique_ptr<ChildProcess> begun(const Confines& confines,
                                    const std::function<void(std::FILE* out)>& work) {
    auto shared = std::make_unique<ChildProcess::Shared>();
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid == 0) {
        begin_doing(shared->doing.descriptor());
        const auto alone = [&](std::FILE* out) {
            close_all_but(fileno(out));
            work(out);
        };
        work_as_child(confines, parent, alone, shared->answer.get());
    }
    return std::make_unique<ChildProcess>(confines, std::move(shared), pid);
}

}  // namespace

Confined::Confined(const Confines& confines, const std::function<void(std::FILE* out)>& work)
    : child_(begun(confines, work)) {}

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
    return rest_of(file);
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
    const bool is_there = take_bool(answer.get());
    auto text = take_all<std::string>(answer.get());
    if (!is_there) return std::nullopt;
    return text;
}

}  // namespace scipd::sim
