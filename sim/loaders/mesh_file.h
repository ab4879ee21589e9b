// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/mesh.h"

namespace scipd::sim {

/// The triangles of one material of a file.
struct MeshPart {
    std::string material;  ///< as the file names it; empty where it names none
    Mesh mesh;
};

/// OBJ, STL, PLY, DAE and whatever else Assimp reads: all triangles of the file as one mesh, its
/// own transforms applied, coordinates as they stand in the file (no axis is turned). Throws
/// LoadError.
Mesh load_mesh(const std::filesystem::path& file, const glm::dvec3& scale = {1.0, 1.0, 1.0});

/// The same, one part for every material of the file.
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file,
                                      const glm::dvec3& scale = {1.0, 1.0, 1.0});

}  // namespace scipd::sim
