// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "sim/world/mesh.h"

namespace scipd::sim {

/// A closed line; the way from its last point to its first belongs to it.
using Outline = std::vector<glm::dvec2>;

/// What lies between z = 0 and z = height_m over the area that these outlines enclose: walls, a
/// floor and a top. An outline within another one is a hole, one within that is an island, as the
/// even-odd rule has it. Outlines that cross themselves or each other get right walls and wrong
/// tops.
Mesh extrusion_mesh(const std::vector<Outline>& outlines, double height_m);

}  // namespace scipd::sim
