// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the floats of the backends are counted from: near what a world mostly is, so that one thing
// far out costs nobody but who looks at it. Values; any thread.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "sim/world/scene.h"

namespace scipd::sim {

/// The middle of all objects at load, in W and in whole metres, so that round coordinates stay
/// round. In a world of more than 2 km what lies farther than 1 km from where most objects are does
/// not count.
glm::dvec3 anchor_of(const Scene& scene);

/// What floats cost most.
struct Coarseness {
    ObjectId object;
    double distance_m;  ///< of its farthest point from the anchor, along one axis of W
    double error_m;     ///< of ranges there: the spacing of floats at that distance
};

/// Nothing where no object that reaches farther than others has an error above `tolerable_m`.
/// Planes do not count, which are as exact at any distance.
std::optional<Coarseness> coarsest(const Scene& scene, double tolerable_m = 1e-4);

}  // namespace scipd::sim
