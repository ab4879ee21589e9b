// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads meshes with Assimp. The library is large and the files come from outside, so
// confined_mesh.h calls this in child processes, where it can do no harm. Any thread; nothing
// shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

/// How much of a file the library gets to see.
enum class MeshContents {
    all,
    relieved,  ///< reduced, as in mesh_relief.h
};

/// As load_mesh_parts() without a scale. Throws std::runtime_error, saying what is wrong, or
/// std::bad_alloc.
std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes,
                                const MeshLimits& limits, MeshContents contents);

/// Only the submesh of this name, where it lies in the file (as_in_file). Throws the same.
std::vector<MeshPart> read_submesh(const std::filesystem::path& file, const std::string& name,
                                   const MeshLimits& limits, MeshContents contents);

}  // namespace scipd::sim
