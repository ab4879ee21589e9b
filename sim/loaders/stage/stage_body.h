// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What an entity of Stage looks like: blocks, or the dark pixels of a bitmap, as Stage scales them
// into the entity's size. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/stage/stage_file.h"
#include "sim/world/mesh.h"

namespace scipd::sim {

/// Lengths and angles as the file has them.
struct StageUnits {
    double metres = 1.0;
    double radians;
};

/// Of the entity, the default of Stage where it has none. Throws std::invalid_argument.
glm::dvec3 stage_size_m(const StageEntity& entity, const StageUnits& units);

/// A prism for each of its blocks, x and y from the middle of all, z from its foot. Throws
/// std::invalid_argument.
std::vector<Mesh> block_meshes(const StageEntity& entity, const glm::dvec3& size_m,
                               const StageUnits& units);

/// The picture's dark pixels, whose outer ones lie on the rim of the size. Throws
/// std::invalid_argument, also where there is none.
Mesh bitmap_mesh(std::string_view picture, const glm::dvec3& size_m, std::size_t most_triangles);

}  // namespace scipd::sim
