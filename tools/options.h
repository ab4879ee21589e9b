// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How all the small programs read their options and end: 0 as asked, 1 failed while running, 2
// wrong options or input.
#pragma once

#include <stdexcept>

#include <CLI/CLI.hpp>

namespace scipd::tools {

/// What a user named cannot be used as it is.
struct WrongInput : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// For every option that is a real number: within these limits, and a number at all. (CLI::Range
/// lets "nan" pass.)
[[nodiscard]] CLI::Validator number_within(double least, double most);

/// Reads the options, carries out the command and tells what went wrong on standard error. Returns
/// the exit code.
int run(CLI::App& program, int argc, char** argv);

}  // namespace scipd::tools
