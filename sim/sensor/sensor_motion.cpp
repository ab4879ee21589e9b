// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace scipd::sim {

SensorMotion motion_of(std::span<const Pose> world_from_sensor) {
    assert(!world_from_sensor.empty());
    SensorMotion motion{world_from_sensor[world_from_sensor.size() / 2]};
    double farthest_m2 = 0.0;
    const Pose* most_turned = &motion.middle;
    double least_cosine = 1.0;
    for (const Pose& pose : world_from_sensor) {
        const glm::dvec3 moved_m = pose.translation_m - motion.middle.translation_m;
        farthest_m2 = std::max(farthest_m2, glm::dot(moved_m, moved_m));
        const double cosine = std::abs(glm::dot(pose.rotation, motion.middle.rotation));
        if (cosine >= least_cosine) continue;
        least_cosine = cosine;
        most_turned = &pose;
    }
    motion.moved_m = std::sqrt(farthest_m2);
    motion.turned_rad = angle_between_rad(most_turned->rotation, motion.middle.rotation);
    return motion;
}

}  // namespace scipd::sim
