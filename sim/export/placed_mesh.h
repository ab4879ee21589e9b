// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The objects of a world as triangles that have names and places, for files of others. Values; any
// thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

struct PlacedMesh {
    std::string name;      ///< MODEL::LINK::VISUAL
    std::string material;  ///< its name
    SharedMesh mesh;
    glm::dvec3 scale{1.0};  ///< of the mesh in its own frame
    Pose world_from_mesh = {};

    [[nodiscard]] glm::dvec3 vertex_m(std::uint32_t index) const {
        return world_from_mesh * (scale * glm::dvec3{mesh->vertices_m[index]});
    }
};

/// How far the triangles of round shapes may lie from them.
inline constexpr double export_tolerance_m = 1e-3;

/// A shape that many objects share, and how it is stretched to become that of one: all boxes are
/// one box. A cylinder's sides depend on its radius alone.
struct Stretched {
    Shape shape;
    glm::dvec3 scale{1.0};
};
Stretched stretched(const Shape& shape);

/// All objects of the scene, with its models at load.
std::vector<PlacedMesh> placed_meshes(const Scene& scene);

}  // namespace scipd::sim
