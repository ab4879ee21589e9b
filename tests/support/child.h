// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A program under test as a process of its own, with its output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/support/temp_dir.h"

namespace scipd::tests {

struct Outcome {
    int exit_code = -1;  ///< -1: a signal ended it
    std::string out;
    std::string err;
};

class Child {
  public:
    /// `input` is the program's standard input. Throws std::system_error.
    explicit Child(const std::vector<std::string>& command, const std::string& input = {});
    /// Kills the process if it still runs.
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    void signal(int number) const;
    [[nodiscard]] Outcome wait();

  private:
    TempDir directory_;
    pid_t pid_ = -1;  ///< -1: it has ended
};

[[nodiscard]] Outcome run(const std::vector<std::string>& command, const std::string& input = {});

[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace scipd::tests
