// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The numbers of a message as a pose. Any thread; nothing shared.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "sim/expected.h"
#include "sim/world/pose.h"
#include "sim/world/reach.h"

namespace scipd::daemon {

/// The place, and a quaternion x, y, z, w. Refused where they are no place and no rotation; `what`
/// tells whose they are.
inline sim::Expected<sim::Pose> checked_pose(const std::string& what,
                                             const std::array<double, 3>& xyz_m,
                                             const std::array<double, 4>& q) {
    const glm::dvec3 place_m{xyz_m[0], xyz_m[1], xyz_m[2]};
    if (!sim::plausible_position(place_m))
        return sim::refuse(what + " must lie within 1e7 m of the origin");
    const glm::dquat rotation{q[3], q[0], q[1], q[2]};
    const double length = glm::length(rotation);
    // Senders that leave a rotation out leave four zeros. What they round is nearer to 1.
    if (!(std::abs(length - 1.0) <= 0.02))
        return sim::refuse(what + " must have a quaternion of length 1");
    return sim::Pose{place_m, rotation / length};
}

/// What a robot tells in its own frame, in that of its parent. Nothing where no robot moves so.
inline std::optional<sim::Velocity> velocity_in_parent(const glm::dquat& parent_from_child,
                                                       const std::array<double, 3>& linear_mps,
                                                       const std::array<double, 3>& angular_radps) {
    const glm::dvec3 linear{linear_mps[0], linear_mps[1], linear_mps[2]};
    const glm::dvec3 angular{angular_radps[0], angular_radps[1], angular_radps[2]};
    constexpr double fastest = 1e6;
    // Written so that what is not a number is no velocity.
    if (!(glm::length(linear) <= fastest) || !(glm::length(angular) <= fastest))
        return std::nullopt;
    return sim::Velocity{parent_from_child * linear, parent_from_child * angular};
}

}  // namespace scipd::daemon
