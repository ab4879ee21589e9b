// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_file.h"

#include <algorithm>
#include <cctype>

#include "sim/loaders/file/load_error.h"
#include "sim/world/bounds.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

Bounds bounds_of_all(const std::vector<MeshPart>& parts) {
    Bounds bounds;
    for (const MeshPart& part : parts) {
        for (const glm::vec3& vertex : part.mesh.vertices_m)
            bounds.include(glm::dvec3{vertex});
    }
    return bounds;
}

bool is_plausible(const MeshPart& part) {
    return std::ranges::all_of(part.mesh.vertices_m, [](const glm::vec3& vertex) {
        return plausible_position(glm::dvec3{vertex});
    });
}

}  // namespace

void place(std::vector<MeshPart>& parts, bool centred, const glm::dvec3& scale,
           const fs::path& file) {
    const glm::dvec3 origin = centred ? bounds_of_all(parts).middle_m() : glm::dvec3{0.0};
    for (MeshPart& part : parts) {
        for (glm::vec3& vertex : part.mesh.vertices_m)
            vertex = glm::vec3{(glm::dvec3{vertex} - origin) * scale};
    }
    if (!std::ranges::all_of(parts, is_plausible)) {
        throw LoadError({file.string() +
                         ": has a vertex that is not finite, or more than 1e7 m from its origin; "
                         "is it in metres, and its scale right?"});
    }
}

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool is_mesh_file(const fs::path& file) {
    return std::ranges::find(mesh_extensions, extension_of(file)) != mesh_extensions.end();
}

}  // namespace scipd::sim
