// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/placed_mesh.h"

#include <memory>
#include <variant>

namespace scipd::sim {
namespace {

struct Common {
    Stretched operator()(const Box& box) const { return {Box{{1, 1, 1}}, box.size_m}; }
    Stretched operator()(const Cylinder& cylinder) const {
        return {Cylinder{cylinder.radius_m, 1.0}, {1.0, 1.0, cylinder.length_m}};
    }
    Stretched operator()(const Plane& plane) const {
        return {Plane{{1, 1}}, {plane.size_m.x, plane.size_m.y, 1.0}};
    }
    Stretched operator()(const Sphere& sphere) const { return {sphere}; }
    Stretched operator()(const SharedMesh& mesh) const { return {mesh}; }
};

}  // namespace

Stretched stretched(const Shape& shape) {
    return std::visit(Common{}, shape);
}

std::vector<PlacedMesh> placed_meshes(const Scene& scene) {
    std::vector<PlacedMesh> placed;
    placed.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        const auto [shape, scale] = stretched(object.shape);
        const auto* shared = std::get_if<SharedMesh>(&shape);
        placed.push_back({.name = object.name,
                          .material = scene.materials[object.material].name,
                          .mesh = shared != nullptr ? *shared
                                                    : std::make_shared<const Mesh>(
                                                          tessellate(shape, export_tolerance_m)),
                          .scale = scale,
                          .world_from_mesh = scene.models[object.model].world_from_model *
                                             object.model_from_object});
    }
    return placed;
}

}  // namespace scipd::sim
