// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mesh files: OBJ with MTL, STL, PLY, COLLADA, glTF and GLB. This header has the parts that a file
// holds, and what is known of a file before it is read. mesh_parts.h reads it. Any thread; nothing
// shared.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/material.h"
#include "sim/world/mesh.h"

namespace scipd::sim {

/// The triangles of one material of a file.
struct MeshPart {
    std::string material;  ///< as the file names it; empty if it names none
    Mesh mesh;
    Appearance appearance = {};
};

/// What reading one file may take. The library takes up to 600 bytes a triangle (load_bench).
struct MeshLimits {
    std::size_t memory_bytes = std::size_t{4} << 30U;
    std::size_t triangles = 10'000'000;
    std::chrono::milliseconds wall_time = std::chrono::minutes{2};
};

/// A whole file or, if `submesh` is not empty, its submesh of this name. The name is that of a node
/// (OBJ: of an object or group) or of a mesh.
struct MeshSource {
    std::filesystem::path file;
    std::string submesh;

    std::strong_ordering operator<=>(const MeshSource&) const = default;
};

/// Which way is up.
enum class MeshAxes {
    /// Coordinates stay as in the file. Gazebo and RViz do so with every format: neither applies a
    /// COLLADA <up_axis>, and both leave a glTF lying on its back.
    as_in_file,
    /// Coordinates are turned to z up if the format tells what is up: <up_axis> in COLLADA (y if
    /// there is none), y in glTF. Other formats do not tell, and their coordinates stay.
    z_up,
};

inline constexpr std::array<std::string_view, 6> mesh_extensions{".obj", ".stl",  ".ply",
                                                                 ".dae", ".gltf", ".glb"};

/// With its dot, in lower case.
std::string extension_of(const std::filesystem::path& file);

/// Judges by the name only.
bool is_mesh_file(const std::filesystem::path& file);

/// Scales parts that are in the coordinates of `file`; if `centred`, it first moves the middle of
/// their bounds to the origin. Throws LoadError, which names `file`, if a vertex is then not
/// finite, or more than 1e7 m out.
void place(std::vector<MeshPart>& parts, bool centred, const glm::dvec3& scale,
           const std::filesystem::path& file);

}  // namespace scipd::sim
