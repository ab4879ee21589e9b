// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The one place that knows Assimp. What it is given comes from anywhere and the library is large:
// confined_mesh.h calls this where it can do no harm. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

/// How much of a file the library gets to see.
enum class MeshContents {
    all,
    relieved,  ///< mesh_relief.h
};

/// As load_mesh_parts() without a scale. Throws std::runtime_error, saying what is wrong, or
/// std::bad_alloc.
std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes,
                                const MeshLimits& limits, MeshContents contents);

/// The submesh of this name, where it lies in the file. Throws the same.
std::vector<MeshPart> read_submesh(const std::filesystem::path& file, const std::string& name,
                                   const MeshLimits& limits, MeshContents contents);

}  // namespace scipd::sim
