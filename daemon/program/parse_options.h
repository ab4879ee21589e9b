// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The command line of scipd: it says what to run, or asks for an answer after which scipd ends. Any
// thread; nothing shared.
#pragma once

#include <variant>

#include "daemon/program/answers.h"
#include "daemon/program/run_options.h"

namespace scipd::daemon {

/// Never throws on any arguments; argv[0] is the program.
std::variant<Options, Answer> parse_options(int argc, const char* const* argv);

}  // namespace scipd::daemon
