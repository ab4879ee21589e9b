// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the parts of an SDF document lie, from libsdformat's poses. Values; any thread.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <ignition/math/Pose3.hh>

#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Where a link or a nested model lies, and the body that it belongs to.
struct Place {
    ModelId body;
    Pose body_from_here;
    Pose world_from_here;  ///< at load
};

inline Pose to_pose(const ignition::math::Pose3d& pose) {
    const auto& p = pose.Pos();
    const auto& q = pose.Rot();
    return {{p.X(), p.Y(), p.Z()}, glm::normalize(glm::dquat{q.W(), q.X(), q.Y(), q.Z()})};
}

inline Place operator*(const Place& outer, const Pose& outer_from_here) {
    return {outer.body, outer.body_from_here * outer_from_here,
            outer.world_from_here * outer_from_here};
}

}  // namespace scipd::sim
