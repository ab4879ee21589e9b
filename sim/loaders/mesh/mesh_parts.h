// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads mesh files (mesh_file.h) into parts of one material each. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

/// All triangles of the file, one part for every material, with the file's own transforms applied
/// and, in COLLADA, its <unit>; other files are in metres. A child process reads the file, so that
/// one that takes too much time or memory, or crashes the library, is refused like any other faulty
/// file. Throws LoadError.
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file,
                                      const glm::dvec3& scale = {1.0, 1.0, 1.0},
                                      MeshAxes axes = MeshAxes::as_in_file,
                                      const MeshLimits& limits = {});

}  // namespace scipd::sim
