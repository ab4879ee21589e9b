// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the command line asks scipd to run. A value; any thread.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "daemon/config/config.h"

namespace scipd::daemon {

struct Options {
    Config config;
    /// The file of the configuration, which SIGHUP has read again; nothing: it came from options.
    std::optional<std::filesystem::path> config_file;
    /// trace, debug, info, warning (or warn), error, critical or off.
    std::string log_level = "info";
    std::string log_format = "text";  ///< or "json"
    bool strict = false;              ///< whatever the configuration says
    /// How many threads sensors live on.
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    /// In the place of what the configuration says; empty: that holds.
    std::filesystem::path scenario = {};
    /// The same of `http`; nothing in it: no control API on TCP.
    std::optional<std::optional<Address>> http = {};

    /// Puts what holds whatever the configuration says into it.
    void put_into(Config& read) const {
        read.strict |= strict;
        if (http) read.http = *http;
        if (scenario.empty()) return;
        read.scenario = scenario;
        read.places.erase("scenario");
    }
};

}  // namespace scipd::daemon
