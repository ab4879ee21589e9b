// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The one place that knows Assimp. What it is given comes from anywhere and the library is large:
// mesh_file.h calls this where it can do no harm. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sim/loaders/mesh_file.h"

namespace scipd::sim {

inline constexpr std::size_t most_mesh_triangles = 10'000'000;

/// As load_mesh_parts() without a scale. Throws std::runtime_error, saying what is wrong.
std::vector<MeshPart> read_mesh(const std::filesystem::path& file, MeshAxes axes);

}  // namespace scipd::sim
