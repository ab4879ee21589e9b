// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a world file of Stage. Its models and robots (`position`) stand where they begin, at the
// height that Stage gives them, with bodies of blocks or of the dark pixels of a bitmap. Robots
// are movable. A sensor has a body only if the file gives it one. There is no floor. Any thread;
// nothing shared.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/stage/stage_file.h"
#include "sim/world/mesh.h"

namespace scipd::sim {

/// Whether a .world is one of Stage, and not of Gazebo, which is XML.
bool is_stage(std::string_view text);

/// Throws LoadError.
LoadedScene load_stage(const std::filesystem::path& file);

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
