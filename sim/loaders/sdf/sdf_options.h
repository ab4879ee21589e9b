// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What an SDF world or a robot does not say itself of how it is to be read. A value.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

enum class SdfGeometry { visual, collision };

struct SdfOptions {
    SdfGeometry geometry = SdfGeometry::visual;
    /// Where models are looked for that are nowhere else (resources.h).
    std::vector<std::filesystem::path> model_folders = {};
    /// libsdformat takes about 170 kB for a visual and 2 MB for a model, so that a small file can
    /// be a large world. What would take more than this is refused before it is read.
    std::size_t most_memory_bytes = std::size_t{4} << 30U;
    std::size_t most_triangles = 20'000'000;
    MeshLimits mesh = {};  ///< of each file
    /// Every warning is a fault, and so is what libsdformat has against the parts that are nothing
    /// to a scanner.
    bool strict = false;
};

}  // namespace scipd::sim
