// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files of meshes, read as the loaders of worlds read them, in the forms that tests look at.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/loaders/mesh/confined_mesh.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_parts.h"

namespace scipd::sim {

/// All of the file as one mesh.
inline Mesh load_mesh(const std::filesystem::path& file,
                      const glm::dvec3& scale = {1.0, 1.0, 1.0}) {
    Mesh whole;
    for (const auto& part : load_mesh_parts(file, scale)) {
        const auto first = static_cast<glm::uint>(whole.vertices_m.size());
        whole.vertices_m.insert(whole.vertices_m.end(), part.mesh.vertices_m.begin(),
                                part.mesh.vertices_m.end());
        for (const auto& triangle : part.mesh.triangles)
            whole.triangles.push_back(triangle + first);
    }
    return whole;
}

/// As it lies in the file.
inline std::vector<MeshPart> load_submesh(const std::filesystem::path& file, std::string name,
                                          const MeshLimits& limits = {}) {
    return MeshReading{file, std::move(name), MeshAxes::as_in_file, limits}.parts();
}

}  // namespace scipd::sim
