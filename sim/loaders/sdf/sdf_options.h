// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Options for reading an SDF world or a robot, beyond what the file itself says. A value.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

enum class SdfGeometry { visual, collision };

/// The element of what scanners see.
constexpr const char* seen_element(SdfGeometry geometry) {
    return geometry == SdfGeometry::visual ? "visual" : "collision";
}

/// Values of the arguments that a file in xacro declares (<xacro:arg>), by name.
using XacroArguments = std::map<std::string, std::string>;

struct SdfOptions {
    SdfGeometry geometry = SdfGeometry::visual;
    XacroArguments xacro = {};  ///< for each file in xacro; those without one keep their default
    /// Folders to search for models that are nowhere else (resources.h).
    std::vector<std::filesystem::path> model_folders = {};
    /// Includes can make a large world of a small file. scipd refuses a world that takes more than
    /// this.
    std::size_t most_memory_bytes = std::size_t{4} << 30U;
    std::size_t most_triangles = 20'000'000;
    MeshLimits mesh = {};  ///< for each mesh file
    /// Every warning is a fault.
    bool strict = false;
};

}  // namespace scipd::sim
