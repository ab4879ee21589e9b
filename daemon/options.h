// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The command line of scipd: what is to run, or an answer after which there is nothing to do. Any
// thread; nothing shared.
#pragma once

#include <variant>

#include "daemon/answers.h"
#include "daemon/option_groups.h"

namespace scipd::daemon {

/// Never throws on any arguments; argv[0] is the program.
std::variant<Options, Answer> parse_options(int argc, const char* const* argv);

}  // namespace scipd::daemon
