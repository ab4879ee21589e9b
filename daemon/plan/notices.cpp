// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/notices.h"

#include <algorithm>
#include <map>
#include <optional>

namespace scipd::daemon {
namespace {

/// What says how faces reflect; empty: nothing does.
std::string what_counts(const Config& config, const sim::Scene& scene,
                        const sim::MaterialLibrary& library) {
    const auto is_bright = [](const sim::Material& material) {
        return material.laser_retro.value_or(0.0) > 0.0;
    };
    // Scripts of Gazebo are there for their colour, and this floor comes with scipd.
    const auto is_named = [&](const sim::Object& object) {
        const sim::Material& material = scene.materials[object.material];
        return material.name != scene.materials.front().name && !material.from_script &&
               library.find(material.name) != nullptr &&
               scene.models[object.model].name != "ground_plane";
    };
    if (!config.materials.empty()) return config.place_of("materials") + "names materials";
    if (std::ranges::any_of(scene.materials, is_bright))
        return config.scene.string() + " defines laser_retro values";
    if (std::ranges::any_of(scene.objects, is_named))
        return config.scene.string() + " defines materials";
    return {};
}

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

std::vector<std::string> media_notices(const Config& config) {
    if (config.media.empty() || config.any_sees_light()) return {};
    return {config.place_of("media") + std::string(unseen_media)};
}

std::vector<std::string> material_notices(const Config& config, const sim::Scene& scene,
                                          const sim::MaterialLibrary& library) {
    const bool has_scanners = std::ranges::any_of(config.robots, [](const RobotConfig& robot) {
        return std::ranges::any_of(robot.sensors,
                                   [](const SensorConfig& sensor) { return !sensor.staring; });
    });
    if (!has_scanners || config.any_sees_light()) return {};
    const std::string what = what_counts(config, scene, library);
    if (what.empty()) return {};
    return {what + ", but they have no effect: no scanner uses `accuracy: material`"};
}

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
