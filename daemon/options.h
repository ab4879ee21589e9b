// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The command line of scipd: what is to run, or an answer after which there is nothing to do. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "daemon/answers.h"
#include "daemon/config/config.h"

namespace scipd::daemon {

/// What is to run.
struct Options {
    Config config;
    /// Where the configuration came from, to be read again at SIGHUP; nothing: from options.
    std::optional<std::filesystem::path> config_file;
    /// trace, debug, info, warning (or warn), error, critical or off.
    std::string log_level = "info";
    bool strict = false;  ///< whatever the configuration says
};

/// Never throws on any arguments; argv[0] is the program.
std::variant<Options, Answer> parse_options(int argc, const char* const* argv);

}  // namespace scipd::daemon
