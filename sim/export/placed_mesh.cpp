// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/placed_mesh.h"

#include <memory>
#include <variant>

namespace scipd::sim {

std::vector<PlacedMesh> placed_meshes(const Scene& scene) {
    std::vector<PlacedMesh> placed;
    placed.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        const auto* shared = std::get_if<SharedMesh>(&object.shape);
        placed.push_back({.name = object.name,
                          .material = scene.materials[object.material].name,
                          .mesh = shared != nullptr ? *shared
                                                    : std::make_shared<const Mesh>(tessellate(
                                                          object.shape, export_tolerance_m)),
                          .world_from_mesh = scene.models[object.model].world_from_model *
                                             object.model_from_object});
    }
    return placed;
}

}  // namespace scipd::sim
