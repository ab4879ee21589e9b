// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the command line asks scipd to run. A value; any thread.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// What holds whatever the configuration says; nothing, or empty: that holds.
struct Overrides {
    std::filesystem::path scene = {};
    sim::XacroArguments xacro = {};  ///< of all that the configuration has, these are replaced
    std::optional<sim::SdfGeometry> geometry = {};
    std::filesystem::path materials = {};
    std::optional<ClockKind> clock = {};
    std::optional<std::uint64_t> seed = {};
    std::filesystem::path control = {};
    BrokerAddress broker = {};
    std::string world = {};  ///< of the broker's
    std::filesystem::path scenario = {};
    /// Nothing in it: no control API on TCP.
    std::optional<std::optional<Address>> http = {};
    bool strict = false;
    /// Each scanner listens on a free port of this machine alone, and has no tty.
    bool free_ports = false;

    void put_into(Config& read) const;
};

struct Options {
    Config config;
    /// The file of the configuration, which SIGHUP has read again; nothing: it came from options.
    std::optional<std::filesystem::path> config_file;
    Overrides overrides;
    /// trace, debug, info, warning (or warn), error, critical or off.
    std::string log_level = "info";
    std::string log_format = "text";  ///< or "json"
    /// How many threads sensors live on.
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

}  // namespace scipd::daemon
