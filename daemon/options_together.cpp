// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/options_together.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "daemon/option_groups.h"

namespace scipd::daemon {
namespace {

/// Where a configuration says what this option of a scanner or its robot says; empty: it is no such
/// option.
std::string key_of(const std::string& option) {
    constexpr std::array<std::string_view, 2> of_robot{"pose", "poses"};
    constexpr std::array<std::string_view, 8> of_sensor{
        "model", "mount", "tcp", "pty", "backend", "accuracy", "timing", "power-up"};
    std::string name = option.substr(2);
    if (name == "name") return "robots.ROBOT.sensors.SENSOR";
    if (name == "sensor-from") return "robots.ROBOT.sensors.SENSOR.mount.sensor";
    if (std::ranges::find(of_robot, name) != of_robot.end()) return "robots.ROBOT." + name;
    if (std::ranges::find(of_sensor, name) == of_sensor.end()) return {};
    std::ranges::replace(name, '-', '_');
    return "robots.ROBOT.sensors.SENSOR." + name;
}

sim::Expected<> check_beside(const CLI::Option& alone, const CLI::Option& other) {
    const std::string key = key_of(other.get_name());
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
