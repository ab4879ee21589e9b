// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_scenario.h"

#include <string>
#include <vector>

#include "daemon/plan/load_world.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

/// Cameras and rangers have no faults.
std::vector<std::string> scanners_of(const Config& config) {
    std::vector<std::string> scanners;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors) {
            if (!sensor.staring) scanners.push_back(sensor_name(robot.name, sensor.name));
        }
    }
    return scanners;
}

}  // namespace

std::optional<Scenario> load_scenario(const Config& config) {
    if (config.scenario.empty()) return std::nullopt;
    try {
        return load_scenario(config.scenario, scanners_of(config));
    } catch (const sim::LoadError& error) {
        throw named_at(config.place_of("scenario"), error);
    }
}

}  // namespace scipd::daemon
