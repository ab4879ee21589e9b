// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Options for reading an SDF world or a robot, beyond what the file itself says. A value.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

enum class SdfGeometry { visual, collision };

struct SdfOptions {
    SdfGeometry geometry = SdfGeometry::visual;
    /// Folders to search for models that are nowhere else (resources.h).
    std::vector<std::filesystem::path> model_folders = {};
    /// libsdformat takes about 170 kB for a visual and 2 MB for a model, so a small file can be a
    /// large world. scipd refuses a world that would take more than this, before it reads it.
    std::size_t most_memory_bytes = std::size_t{4} << 30U;
    std::size_t most_triangles = 20'000'000;
    MeshLimits mesh = {};  ///< for each mesh file
    /// Every warning is a fault, and so is every complaint of libsdformat, even about parts that do
    /// not matter to a scanner.
    bool strict = false;
};

}  // namespace scipd::sim
