// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/bounds.h"

#include <limits>

#include <glm/common.hpp>

namespace scipd::sim {
namespace {

struct BoundsOf {
    Bounds operator()(const Box& box) const { return {-0.5 * box.size_m, 0.5 * box.size_m}; }
    Bounds operator()(const Cylinder& cylinder) const {
        const glm::dvec3 corner{cylinder.radius_m, cylinder.radius_m, 0.5 * cylinder.length_m};
        return {-corner, corner};
    }
    Bounds operator()(const Sphere& sphere) const {
        return {glm::dvec3{-sphere.radius_m}, glm::dvec3{sphere.radius_m}};
    }
    Bounds operator()(const Plane& plane) const {
        const glm::dvec3 corner{0.5 * plane.size_m, 0.0};
        return {-corner, corner};
    }
    Bounds operator()(const SharedMesh& mesh) const {
        Bounds bounds;
        for (const glm::vec3& vertex : mesh->vertices_m)
            bounds.include(glm::dvec3{vertex});
        return bounds;
    }
};

}  // namespace

Bounds::Bounds()
    : low_m(std::numeric_limits<double>::infinity()),
      high_m(-std::numeric_limits<double>::infinity()) {}

void Bounds::include(const glm::dvec3& point_m) {
    low_m = glm::min(low_m, point_m);
    high_m = glm::max(high_m, point_m);
}

void Bounds::include(const Bounds& other, const Pose& here_from_other) {
    if (other.empty()) return;
    for (const double x : {other.low_m.x, other.high_m.x}) {
        for (const double y : {other.low_m.y, other.high_m.y}) {
            for (const double z : {other.low_m.z, other.high_m.z}) {
                include(here_from_other * glm::dvec3{x, y, z});
            }
        }
    }
}

Bounds bounds_of(const Shape& shape) {
    return std::visit(BoundsOf{}, shape);
}

Bounds bounds_in_world(const Scene& scene, const Object& object) {
    Bounds bounds;
    bounds.include(bounds_of(object.shape),
                   scene.models[object.model].world_from_model * object.model_from_object);
    return bounds;
}

Bounds extent_of(const Scene& scene) {
    Bounds extent;
    for (const Object& object : scene.objects)
        extent.include(bounds_in_world(scene, object), Pose{});
    return extent;
}

}  // namespace scipd::sim
