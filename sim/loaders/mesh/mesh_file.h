// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files of meshes: OBJ with MTL, STL, PLY, COLLADA, glTF and GLB; what there is to be said of them
// before they are read, and what they hold. Not their reading: that is in mesh_parts.h. Any thread;
// nothing shared.
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

#include "sim/world/mesh.h"

namespace scipd::sim {

/// The triangles of one material of a file.
struct MeshPart {
    std::string material;  ///< as the file names it; empty where it names none
    Mesh mesh;
};

/// What reading one file may take. The library takes up to 600 bytes a triangle (load_bench).
struct MeshLimits {
    std::size_t memory_bytes = std::size_t{4} << 30U;
    std::size_t triangles = 10'000'000;
    std::chrono::milliseconds wall_time = std::chrono::minutes{2};
};

/// All of a file, or its submesh of this name: that of a node (OBJ: the object or group) or mesh.
struct MeshSource {
    std::filesystem::path file;
    std::string submesh;

    std::strong_ordering operator<=>(const MeshSource&) const = default;
};

/// Which way is up.
enum class MeshAxes {
    /// Coordinates as they stand in the file, which is what Gazebo and RViz do with every format:
    /// neither heeds a COLLADA <up_axis>, and both leave a glTF lying on its back.
    as_in_file,
    /// Turned to z up where the format says what is up: by <up_axis> in COLLADA (y where there is
    /// none), y in glTF. The others say nothing and stay.
    z_up,
};

inline constexpr std::array<std::string_view, 6> mesh_extensions{".obj", ".stl",  ".ply",
                                                                 ".dae", ".gltf", ".glb"};

/// With its dot, in small letters.
std::string extension_of(const std::filesystem::path& file);

/// By its name.
bool is_mesh_file(const std::filesystem::path& file);

/// Brings parts as they lie in `file`, the middle of their bounds to the origin if they are to be
/// centred, to this scale. Throws LoadError where a vertex is not finite then, or too far out.
void place(std::vector<MeshPart>& parts, bool centred, const glm::dvec3& scale,
           const std::filesystem::path& file);

}  // namespace scipd::sim
