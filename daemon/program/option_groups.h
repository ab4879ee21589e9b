// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The options of the command line, group by group: their help texts, the values that a user gave,
// and which go together. parse_options.cpp decides what follows. At the start, on the only thread.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/App.hpp>

#include "daemon/program/answers.h"
#include "daemon/program/run_options.h"
#include "sim/expected.h"

namespace scipd::daemon {

/// The title of the options each of which leaves no room for most others.
inline constexpr const char* alone_title = "Instead of the above";
/// The titles of the options that describe a robot and its scanner.
inline constexpr const char* robot_title = "Robot";
inline constexpr const char* scanner_title = "Scanner";
/// The title of what is written of a world in place of running it.
inline constexpr const char* map_title = "Instead of running, a map of the world";
/// The title of the options that go with all others.
inline constexpr const char* general_title = "General";

/// What a user gave by options, or what holds where the user gave nothing. parse_options.cpp
/// decides later which of it counts.
struct OptionValues {
    OptionValues();

    Options options;
    RobotConfig robot;
    SensorConfig sensor;  ///< of the kind that stands alone, until options say otherwise
    bool start_given = false;
    bool mount_given = false;
    bool model_given = false;
    std::filesystem::path config;
    std::filesystem::path check;
    MapRequest map;
    bool list_models = false;
    bool list_backends = false;
    bool probe = false;
    std::string completion;
};

/// Their texts go through the parsers of daemon/config, whose refusals become CLI's.
void add_options(CLI::App& app, OptionValues& said);

/// Refuses options that do not go together. --config goes with those that are of no scanner.
[[nodiscard]] sim::Expected<> check_together(const CLI::App& app);

/// The option that reads this file, followed by the file; empty if it is not there or of no use.
[[nodiscard]] std::string option_for(const std::string& file);

/// Text to use instead of a word that scipd does not know; empty: none.
[[nodiscard]] std::string replacement_for(const std::string& word);

}  // namespace scipd::daemon
