// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Meshes from files (mesh_file.h), as the parts that have one material each. Any thread; nothing
// shared.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

/// All triangles of the file, one part for every material, with the file's own transforms applied
/// and, in COLLADA, its <unit>; other files are in metres. It is read in a child process, so that
/// one that takes too much of anything, or crashes the library, is refused like any other. Throws
/// LoadError.
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file,
                                      const glm::dvec3& scale = {1.0, 1.0, 1.0},
                                      MeshAxes axes = MeshAxes::as_in_file,
                                      const MeshLimits& limits = {});

}  // namespace scipd::sim
