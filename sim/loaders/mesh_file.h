// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>

#include <glm/vec3.hpp>

#include "sim/world/mesh.h"

namespace scipd::sim {

/// OBJ, STL, PLY, DAE and whatever else Assimp reads: all triangles of the file as one mesh, its own transforms
/// applied. Throws LoadError.
Mesh load_mesh(const std::filesystem::path& file, const glm::dvec3& scale = {1.0, 1.0, 1.0});

}  // namespace scipd::sim
