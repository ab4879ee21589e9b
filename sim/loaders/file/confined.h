// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Runs work that cannot be trusted in a copy of this process (fork()). If the work loops, hangs,
// takes all memory or crashes, only the copy ends. It is cheap where this process is small, and for
// processes with a single thread: scipd-read does so, and scipd does not.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/loaders/file/child_process.h"

namespace scipd::sim {

/// Runs `work` in a child. The work has standard input, output and error, and may open some files.
/// The child ends with this object.
class Confined {
  public:
    Confined(const Confines& confines, const std::function<void(std::FILE* out)>& work);

    /// As ChildProcess::outcome().
    File outcome() { return child_->outcome(); }

  private:
    std::unique_ptr<ChildProcess> child_;
};

inline File run_confined(const Confines& confines,
                         const std::function<void(std::FILE* out)>& work) {
    return Confined{confines, work}.outcome();
}

/// Runs a program and returns what it prints on standard output, up to 256 MiB; nothing if the PATH
/// has no program of this name. The program gets these words as they are, without a shell, and an
/// empty standard input. Throws std::runtime_error as outcome() does or, if the program fails, with
/// what it printed on standard error.
std::optional<std::string> output_of(const Confines& confines,
                                     const std::vector<std::string>& command);

}  // namespace scipd::sim
