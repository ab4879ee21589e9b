// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_parts.h"

#include "sim/loaders/mesh/confined_mesh.h"

namespace scipd::sim {
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file, const glm::dvec3& scale,
                                      MeshAxes axes, const MeshLimits& limits) {
    auto parts = MeshReading{file, "", axes, limits}.parts();
    place(parts, false, scale, file);
    return parts;
}

}  // namespace scipd::sim
