// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How far out anything may lie: beyond, a number is taken for damage, wherever it comes from. A
// world is cast into in floats, which one thing far out would make coarse for all. Any thread.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace scipd::sim {

/// In each coordinate, and for each size.
inline constexpr double position_limit_m = 1e7;

/// False where it is not finite or further out.
inline bool plausible_position(const glm::dvec3& xyz_m) {
    // Written so that a NaN is implausible.
    return std::abs(xyz_m.x) <= position_limit_m && std::abs(xyz_m.y) <= position_limit_m &&
           std::abs(xyz_m.z) <= position_limit_m;
}

}  // namespace scipd::sim
