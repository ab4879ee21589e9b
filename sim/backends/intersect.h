// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One ray against one shape, both in the frame of the shape, in double precision. Pure.
#pragma once

#include <limits>
#include <optional>

#include <glm/vec3.hpp>

#include "sim/world/shape.h"

namespace scipd::sim {

struct Ray {
    glm::dvec3 origin_m;
    glm::dvec3 direction;  ///< unit length
};

/// The first point of a shape along a ray.
struct Crossing {
    double range_m = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0, 0.0, 0.0};  ///< unit length, to either side
};

Crossing intersect(const Ray& ray, const Shape& shape);

/// Where a ray goes through a triangle.
struct Piercing {
    double range_m;
    bool is_back;  ///< its corners go clockwise, seen from where the ray begins
};

/// Nothing where it does not.
std::optional<Piercing> pierce(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c);

}  // namespace scipd::sim
