// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/options_together.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "daemon/program/option_groups.h"

namespace scipd::daemon {
namespace {

/// Where a configuration says what this option says; empty: the option is of no scanner.
std::string key_of(const CLI::Option& option) {
    const std::string robot = "robots.ROBOT";
    const std::string sensor = robot + ".sensors.SENSOR";
    std::string name = option.get_name().substr(2);
    std::ranges::replace(name, '-', '_');
    if (name == "name") return sensor;
    if (name == "sensor_from") return sensor + ".mount.sensor";
    if (name == "loop") return sensor + ".replay.loop";
    if (option.get_group() == robot_title) return robot + '.' + name;
    return option.get_group() == scanner_title ? sensor + '.' + name : "";
}

/// Options that decide how a world is read, so that they go with --check.
constexpr std::array<std::string_view, 2> of_reading{"--xacro", "--geometry"};

sim::Expected<> check_beside(const CLI::Option& alone, const CLI::Option& other) {
    const std::string key = key_of(other);
    if (alone.get_name() == "--check" &&
        std::ranges::find(of_reading, other.get_name()) != of_reading.end())
        return {};
    if (alone.get_name() != "--config")
        return sim::refuse(alone.get_name() + " stands alone: leave " + other.get_name() + " out");
    if (other.get_group() == alone_title)
        return sim::refuse("--config and " + other.get_name() + " do not go together");
    if (key.empty()) return {};
    return sim::refuse(other.get_name() + " is for a scanner without a configuration: beside " +
                       "--config, write " + key + " into the file");
}

}  // namespace

/// Not CLI11's excludes(): it would list every pair in the help.
sim::Expected<> check_together(const CLI::App& app) {
    for (const CLI::Option* alone : app.get_options()) {
        if (alone->get_group() != alone_title || alone->count() == 0) continue;
        for (const CLI::Option* other : app.get_options()) {
            if (other == alone || other->get_group() == general_title || other->count() == 0) {
                continue;
            }
            if (const auto good = check_beside(*alone, *other); !good) return good;
        }
    }
    return {};
}

}  // namespace scipd::daemon
