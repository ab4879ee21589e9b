// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

/// Corners of a polygon, as numbers of points.
using Loop = std::vector<std::size_t>;

/// Triangles of a flat polygon less its holes, which lie within it and apart from each other; the
/// corners of each run either way around. What is no such thing gets some triangles. Takes the time
/// of the cube of the corners where they are unkind.
std::vector<std::array<std::size_t, 3>> triangles_of(Loop outline, std::vector<Loop> holes,
                                                     const std::vector<glm::dvec3>& points);

}  // namespace scipd::sim
