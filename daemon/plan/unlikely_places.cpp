// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/unlikely_places.h"

#include <algorithm>
#include <array>
#include <optional>

#include "daemon/world/outside_world.h"
#include "sim/loaders/file/load_error.h"
#include "sim/text/likely_unit.h"
#include "sim/world/bounds.h"

namespace scipd::daemon {
namespace {

std::array<double, 3> numbers_of(const glm::dvec3& xyz_m) {
    return {xyz_m.x, xyz_m.y, xyz_m.z};
}

/// As the user gave it.
const glm::dvec3& mount_of(const SensorConfig& sensor) {
    return sensor.mount ? sensor.mount->frame_from_sensor.translation_m
                        : sensor.robot_from_sensor.translation_m;
}

/// Mostly there is none, and nobody need know how far the world reaches.
bool could_be_millimetres(const RobotConfig& robot) {
    const auto could_be = [](const glm::dvec3& xyz_m) {
        return sim::could_be_millimetres(numbers_of(xyz_m));
    };
    return could_be(robot.world_from_robot.translation_m) ||
           std::ranges::any_of(robot.sensors, could_be, mount_of);
}

/// A warning for a sensor on a robot whose own place is right.
std::optional<std::string> millimetres(const SensorConfig& sensor, const sim::Pose& robot,
                                       const sim::Bounds& world) {
    const std::array numbers = numbers_of(mount_of(sensor));
    const glm::dvec3 at_m = robot * sensor.robot_from_sensor.translation_m;
    const bool likely = sim::could_be_millimetres(numbers) && outside(world, at_m);
    return likely ? std::optional(sim::millimetres_for_metres(numbers)) : std::nullopt;
}

/// "FILE:LINE: KEY.xyz: ", or the option of a command line.
std::string place_of(const Config& config, const std::string& key, const char* option) {
    const std::string place = config.place_of(key);
    if (place.empty()) return std::string(option) + ": ";
    return place.substr(0, place.size() - 2) + ".xyz: ";
}

void warn_of_millimetres(const Config& config, const RobotConfig& robot, const sim::Bounds& world,
                         std::vector<std::string>& warnings) {
    const std::string key = "robots." + robot.name;
    const sim::Pose& pose = robot.world_from_robot;
    if (const auto warning = millimetres_beside(world, pose.translation_m)) {
        warnings.push_back(place_of(config, key + ".pose", "--pose") + *warning);
        return;
    }
    for (const SensorConfig& sensor : robot.sensors) {
        const auto warning = millimetres(sensor, pose, world);
        if (!warning) continue;
        const std::string mount = key + ".sensors." + sensor.name + ".mount";
        warnings.push_back(place_of(config, mount, "--mount") + *warning);
    }
}

}  // namespace

std::vector<std::string> warnings_of(const Config& config, const sim::Scene& scene) {
    std::vector<std::string> warnings = config.warnings;
    std::optional<sim::Bounds> world;
    for (const RobotConfig& robot : config.robots) {
        if (!could_be_millimetres(robot)) continue;
        if (!world) world = sim::extent_of(scene);
        if (!world->empty()) warn_of_millimetres(config, robot, *world, warnings);
    }
    if (config.strict && !warnings.empty()) throw sim::LoadError(std::move(warnings));
    return warnings;
}

}  // namespace scipd::daemon
