// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How all the small programs read their options and end. Exit code 0: done. 1: failed while
// running. 2: wrong options or input.
#pragma once

#include <cstdint>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "daemon/command_line/completions.h"

namespace scipd::tools {

/// The user named something that cannot be used.
struct WrongInput : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A validator for every option that is a real number. It refuses what is not within these limits,
/// and "nan", which CLI::Range lets pass. --help has the limits of this and of the next, unless
/// they are very far.
[[nodiscard]] CLI::Validator number_within(double least, double most);

/// Takes whole numbers, from least to most.
[[nodiscard]] CLI::Validator whole_within(std::int64_t least, std::int64_t most);
/// Takes whole numbers from least to what an int holds.
[[nodiscard]] CLI::Validator whole_from(std::int64_t least);

/// `PROGRAM completion bash|zsh|fish`, which all tools have.
void add_completion_command(CLI::App& program, const daemon::MoreWords& more = {});

/// Reads the options, runs the command and reports faults on standard error. Returns the exit code.
int run(CLI::App& program, int argc, char** argv);

}  // namespace scipd::tools
