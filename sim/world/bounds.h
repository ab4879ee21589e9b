// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <glm/vec3.hpp>

#include "sim/world/pose.h"
#include "sim/world/scene.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// A box along the axes of some frame; empty as it is made.
struct Bounds {
    glm::dvec3 low_m;
    glm::dvec3 high_m;

    Bounds();
    Bounds(const glm::dvec3& low, const glm::dvec3& high) : low_m(low), high_m(high) {}

    [[nodiscard]] bool empty() const { return low_m.x > high_m.x; }
    [[nodiscard]] glm::dvec3 middle_m() const { return 0.5 * (low_m + high_m); }
    void include(const glm::dvec3& point_m);
    /// All of `other`, whose frame lies at this pose in the frame of these bounds.
    void include(const Bounds& other, const Pose& here_from_other);
};

/// In the frame of the shape.
Bounds bounds_of(const Shape& shape);

/// The box around an object, in W.
Bounds bounds_in_world(const Scene& scene, const Object& object);

/// The box around all of them; empty where there are none.
Bounds extent_of(const Scene& scene);

}  // namespace scipd::sim
