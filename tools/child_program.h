// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Another program that this one starts, with its output in files. It ends with this object, and
// with the thread that made it. One thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace scipd::tools {

/// The program of this name in the folder of the one that runs: in a build as in an installation.
[[nodiscard]] std::filesystem::path program_beside(const std::string& name);

class ChildProgram {
  public:
    /// Its output and errors go to files in `directory` that are called like this. Throws
    /// std::system_error. A program that is not there ends at once with 127.
    ChildProgram(const std::vector<std::string>& command, const std::filesystem::path& directory,
                 const std::string& name);
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;
    ~ChildProgram();

    [[nodiscard]] pid_t pid() const { return pid_; }
    /// Nothing as long as it runs; 128 and more: a signal ended it.
    [[nodiscard]] std::optional<int> exit_code();
    /// What it has written so far.
    [[nodiscard]] std::string output() const;
    [[nodiscard]] std::string errors() const;

  private:
    std::filesystem::path output_;
    std::filesystem::path errors_;
    pid_t pid_ = -1;
    std::optional<int> exit_code_;
};

}  // namespace scipd::tools
