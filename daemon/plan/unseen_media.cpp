// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/unseen_media.h"

#include <algorithm>

namespace scipd::daemon {

std::vector<std::string> media_notices(const Config& config) {
    if (config.media.empty() || config.any_sees_light()) return {};
    return {config.place_of("media") + std::string(unseen_media)};
}

std::vector<std::string> material_notices(const Config& config, const sim::Scene& scene) {
    const auto is_bright = [](const sim::Material& material) {
        return material.laser_retro.value_or(0.0) > 0.0;
    };
    const bool has_scanners = std::ranges::any_of(config.robots, [](const RobotConfig& robot) {
        return std::ranges::any_of(robot.sensors,
                                   [](const SensorConfig& sensor) { return !sensor.staring; });
    });
    const bool bright = std::ranges::any_of(scene.materials, is_bright);
    if (!has_scanners || config.any_sees_light() || (config.materials.empty() && !bright))
        return {};
    const std::string what = bright ? "laser_retro of " + config.scene.string()
                                    : config.place_of("materials") + "materials";
    return {what + " counts at accuracy: material only, and no scanner has that"};
}

}  // namespace scipd::daemon
