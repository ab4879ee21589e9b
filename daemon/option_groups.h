// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The options of the command line and their texts, group by group, and what a user has said with
// them. options.cpp acts on that. At the start, on the only thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "daemon/config/config.h"
#include "sim/expected.h"

namespace CLI {
class App;
}

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

/// What the options say, before it is known which of them count.
struct Said {
    Said();

    Options options;
    RobotConfig robot;
    SensorConfig sensor;  ///< of the kind that stands alone, until options say otherwise
    bool start_given = false;
    bool mount_given = false;
    bool model_given = false;
    std::filesystem::path config;
    std::filesystem::path check;
    bool list_models = false;
    bool list_backends = false;
    bool probe = false;
};

/// Their texts go through the parsers of daemon/config, whose refusals become CLI's.
void add_options(CLI::App& app, Said& said);

/// Refuses other options beside one that stands alone.
[[nodiscard]] sim::Expected<> check_alone(const CLI::App& app);

}  // namespace scipd::daemon
