// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_parts.h"

#include "sim/loaders/mesh/confined_mesh.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::vector<MeshPart> load_mesh_parts(const fs::path& file, const glm::dvec3& scale, MeshAxes axes,
                                      const MeshLimits& limits) {
    auto parts = MeshReading{file, "", axes, limits}.parts();
    place(parts, false, scale, file);
    return parts;
}

std::vector<MeshPart> load_submesh(const fs::path& file, const Submesh& submesh,
                                   const glm::dvec3& scale, const MeshLimits& limits) {
    auto parts = MeshReading{file, submesh.name, MeshAxes::as_in_file, limits}.parts();
    place(parts, submesh.centred, scale, file);
    return parts;
}

Mesh load_mesh(const fs::path& file, const glm::dvec3& scale) {
    Mesh whole;
    for (const auto& part : load_mesh_parts(file, scale)) {
        const auto first = static_cast<glm::uint>(whole.vertices_m.size());
        whole.vertices_m.insert(whole.vertices_m.end(), part.mesh.vertices_m.begin(),
                                part.mesh.vertices_m.end());
        for (const auto& triangle : part.mesh.triangles) {
            whole.triangles.push_back(triangle + first);
        }
    }
    return whole;
}

}  // namespace scipd::sim
