// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/unseen_media.h"

#include <algorithm>

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
    if (!config.materials.empty()) return config.place_of("materials") + "materials";
    if (std::ranges::any_of(scene.materials, is_bright))
        return "laser_retro and materials of " + config.scene.string();
    if (std::ranges::any_of(scene.objects, is_named))
        return "the materials of " + config.scene.string();
    return {};
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
    return {what + " count at accuracy: material only, and no scanner has that"};
}

}  // namespace scipd::daemon
