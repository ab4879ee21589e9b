// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns the heights in a file into the triangles of a <heightmap>. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/shape.h"

namespace scipd::sim {

/// How a world shows heights.
struct TerrainView {
    std::optional<glm::dvec3> size_m;  ///< none: as large as the file says
    glm::dvec3 position_m{0.0};
    std::size_t sampling = 1;
};

struct Terrain {
    SharedMesh surface;
    glm::dvec3 position_m;
    std::vector<std::string> remarks;  ///< what a user should know; they name the file
};

/// The surface that Gazebo makes of this file. The corner pixels of the picture are the corners of
/// <size>, centred on <pos>; the top row has the largest y. Between two pixels are <sampling>
/// bilinear steps, and every square is two triangles. Throws LoadError, which names the file.
Terrain terrain_of(const std::filesystem::path& file, const TerrainView& view,
                   std::size_t most_triangles);

}  // namespace scipd::sim
