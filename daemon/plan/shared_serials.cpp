// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/shared_serials.h"

#include <map>
#include <optional>

namespace scipd::daemon {
namespace {

struct Bearers {
    std::string names;  ///< "robot/front and robot/rear"
    int count = 0;
    bool any_new = false;

    void add(const std::string& name, bool is_new) {
        names += (names.empty() ? "" : " and ") + name;
        ++count;
        any_new = any_new || is_new;
    }
};

/// The number that a scanner's bias is drawn from, if it was given.
std::optional<std::string> given_serial(const SensorConfig& sensor) {
    const bool drawn = !sensor.staring && !sensor.replay && !sensor.model.own_bias;
    if (!drawn || !sensor.model.own_serial) return std::nullopt;
    return sensor.model.profile.serial;
}

}  // namespace

std::vector<std::string> serial_notices(const Config& config, const KnownSensors& running) {
    std::map<std::string, Bearers> by_serial;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            const std::string name = robot.name + "/" + sensor.name;
            if (const auto serial = given_serial(sensor))
                by_serial[*serial].add(name, find_known(running, name, sensor) == nullptr);
        }
    }
    std::vector<std::string> notices;
    for (const auto& [serial, bearers] : by_serial) {
        if (bearers.count < 2 || !bearers.any_new) continue;
        notices.push_back(bearers.names + " have the serial number " + serial +
                          ", so they are one unit and have the same bias; give each its own, with "
                          "serial under profile, or none");
    }
    return notices;
}

}  // namespace scipd::daemon
