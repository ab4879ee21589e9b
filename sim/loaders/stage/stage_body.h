// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Builds the body of an entity of Stage: its blocks, or the dark pixels of its bitmap, scaled to
// the entity's size as Stage does. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/stage/stage_file.h"
#include "sim/world/mesh.h"

namespace scipd::sim {

/// One unit of length and of angle of the file.
struct StageUnits {
    double metres = 1.0;
    double radians;
};

/// The size of the entity, or Stage's default if it has none. Throws std::invalid_argument.
glm::dvec3 stage_size_m(const StageEntity& entity, const StageUnits& units);

/// A prism for each block. x and y are relative to the middle of all blocks, z to the foot of the
/// entity. Throws std::invalid_argument.
std::vector<Mesh> block_meshes(const StageEntity& entity, const glm::dvec3& size_m,
                               const StageUnits& units);

/// The picture's dark pixels, scaled so that the outermost ones reach the edges of the size. Has
/// no triangles if no pixel is dark. Throws std::invalid_argument.
Mesh bitmap_mesh(std::string_view picture, const glm::dvec3& size_m, std::size_t most_triangles);

}  // namespace scipd::sim
