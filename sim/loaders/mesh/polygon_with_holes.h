// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

/// The corners of a polygon, as indices of points.
using Loop = std::vector<std::size_t>;

/// Triangles of a flat polygon without its holes. The holes must lie inside it and must not touch
/// each other; corners may run either way around. For any other polygon the triangles are
/// arbitrary. At worst the time grows with the cube of the number of corners.
std::vector<std::array<std::size_t, 3>> triangles_of(Loop outline, std::vector<Loop> holes,
                                                     const std::vector<glm::dvec3>& points);

}  // namespace scipd::sim
