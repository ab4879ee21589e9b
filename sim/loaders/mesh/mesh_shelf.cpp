// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/mesh_shelf.h"

#include <memory>
#include <utility>

#include "sim/loaders/load_error.h"

namespace scipd::sim {

const std::vector<SharedPart>& MeshShelf::parts_of(const std::filesystem::path& file,
                                                   const sdf::Mesh& mesh) {
    const glm::dvec3 scale{mesh.Scale().X(), mesh.Scale().Y(), mesh.Scale().Z()};
    const Submesh submesh{mesh.Submesh(), mesh.CenterSubmesh()};
    const Key key{file, scale.x, scale.y, scale.z, submesh.name, submesh.centred};
    if (const auto known = parts_.find(key); known != parts_.end()) return known->second;
    auto loaded = submesh.name.empty()
                      ? load_mesh_parts(file, scale, MeshAxes::as_in_file, of_each_)
                      : load_submesh(file, submesh, scale, of_each_);
    std::vector<SharedPart> parts;
    for (auto& part : loaded) {
        parts.push_back({part.material, std::make_shared<const Mesh>(std::move(part.mesh))});
        count(parts.back().mesh);
    }
    return parts_.emplace(key, std::move(parts)).first->second;
}

void MeshShelf::count(const Shape& shape) {
    // Round things matter only where they are large.
    const auto* mesh = std::get_if<SharedMesh>(&shape);
    const auto* sphere = std::get_if<Sphere>(&shape);
    if (mesh != nullptr) triangles_ += (*mesh)->triangles.size();
    if (sphere != nullptr && sphere->radius_m > 1.0) {
        triangles_ += tessellate(shape).triangles.size();
    }
    if (triangles_ <= most_triangles_) return;
    throw LoadError({"with this one the world has more than " + std::to_string(most_triangles_) +
                     " triangles; world_triangles under limits in the configuration allows more"});
}

}  // namespace scipd::sim
