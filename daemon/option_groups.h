// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The options of the command line and their texts, group by group, and what they say. What follows
// from that is options.cpp's affair. At the start, on the only thread.
#pragma once

#include <filesystem>

#include <CLI/App.hpp>

#include "daemon/options.h"

namespace scipd::daemon {

/// What the options say before it is known whether they count.
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

/// Throws std::invalid_argument where an option that stands alone has company.
void check_alone(const CLI::App& app);

}  // namespace scipd::daemon
