// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where to aim: points on convex shapes whose range and incidence are known without casting
// anything. A ray that comes from outside to a point of a convex shape meets nothing of it before,
// and one that comes from inside neither.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "sim/world/pose.h"
#include "sim/world/shape.h"

namespace scipd::sim {

using Rng = std::mt19937_64;

double uniform(Rng& rng, double low, double high);
glm::dvec3 random_direction(Rng& rng);
Pose random_pose(Rng& rng, double reach_m);

struct SurfacePoint {
    glm::dvec3 point_m;
    glm::dvec3 normal;  ///< outward; of unit length
};

struct ConvexShape {
    std::string name;
    Shape shape;
    /// A point on the surface, in the frame of the shape, a little away from its edges.
    SurfacePoint (*random_point)(Rng& rng);
    bool has_inside;
};

/// One of each kind of shape.
std::vector<ConvexShape> convex_shapes();

}  // namespace scipd::sim
