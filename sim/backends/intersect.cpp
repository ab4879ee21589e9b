// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/intersect.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// Where |a + t b| = radius, for vectors of any dimension; nothing where the line stays outside.
struct Roots {
    bool real = false;
    double first = 0.0;
    double second = 0.0;
};

template <typename Vector>
Roots meet_radius(const Vector& a, const Vector& b, double radius) {
    const double bb = glm::dot(b, b);
    const double half = glm::dot(a, b);
    const double discriminant = half * half - bb * (glm::dot(a, a) - radius * radius);
    if (bb == 0.0 || discriminant < 0.0) return {};
    const double root = std::sqrt(discriminant);
    return {true, (-half - root) / bb, (-half + root) / bb};
}

/// A rectangle that is normal to `axis`, at `offset` along it, with these half sizes along the
/// other two axes.
void meet_rectangle(const Ray& ray, int axis, double offset_m, const glm::dvec3& half_m,
                    Crossing& nearest) {
    if (ray.direction[axis] == 0.0) return;
    const double range_m = (offset_m - ray.origin_m[axis]) / ray.direction[axis];
    const glm::dvec3 point = ray.origin_m + range_m * ray.direction;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    if (std::abs(point[u]) > half_m[u] || std::abs(point[v]) > half_m[v]) return;
    glm::dvec3 normal{0.0};
    normal[axis] = 1.0;
    nearest.take_nearer(range_m, normal);
}

/// Moeller and Trumbore: Fast, minimum storage ray/triangle intersection, 1997.
void meet_triangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   Crossing& nearest) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return;
    const glm::dvec3 from_a = ray.origin_m - a;
    const double u = glm::dot(from_a, p) / determinant;
    if (!(u >= 0.0 && u <= 1.0)) return;
    const glm::dvec3 q = glm::cross(from_a, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    if (!(v >= 0.0 && u + v <= 1.0)) return;
    nearest.take_nearer(glm::dot(ac, q) / determinant, glm::normalize(glm::cross(ab, ac)));
}

struct Intersect {
    const Ray& ray;

    Crossing operator()(const Box& box) const {
        Crossing nearest;
        const glm::dvec3 half_m = 0.5 * box.size_m;
        for (int axis = 0; axis < 3; ++axis) {
            meet_rectangle(ray, axis, -half_m[axis], half_m, nearest);
            meet_rectangle(ray, axis, half_m[axis], half_m, nearest);
        }
        return nearest;
    }

    Crossing operator()(const Cylinder& cylinder) const {
        Crossing nearest;
        const double half_m = 0.5 * cylinder.length_m;
        const Roots wall =
            meet_radius(glm::dvec2{ray.origin_m}, glm::dvec2{ray.direction}, cylinder.radius_m);
        if (wall.real) {
            for (const double range_m : {wall.first, wall.second}) {
                const glm::dvec3 point = ray.origin_m + range_m * ray.direction;
                if (std::abs(point.z) > half_m) continue;
                nearest.take_nearer(range_m, glm::dvec3{point.x, point.y, 0.0} / cylinder.radius_m);
            }
        }
        for (const double end_m : {-half_m, half_m}) {
            if (ray.direction.z == 0.0) break;
            const double range_m = (end_m - ray.origin_m.z) / ray.direction.z;
            const glm::dvec2 point{ray.origin_m + range_m * ray.direction};
            if (glm::length(point) > cylinder.radius_m) continue;
            nearest.take_nearer(range_m, {0.0, 0.0, 1.0});
        }
        return nearest;
    }

    Crossing operator()(const Sphere& sphere) const {
        Crossing nearest;
        const Roots surface = meet_radius(ray.origin_m, ray.direction, sphere.radius_m);
        if (!surface.real) return nearest;
        for (const double range_m : {surface.first, surface.second}) {
            nearest.take_nearer(range_m,
                                (ray.origin_m + range_m * ray.direction) / sphere.radius_m);
        }
        return nearest;
    }

    Crossing operator()(const Plane& plane) const {
        Crossing nearest;
        meet_rectangle(ray, 2, 0.0, {0.5 * plane.size_m, 0.0}, nearest);
        return nearest;
    }

    Crossing operator()(const SharedMesh& mesh) const {
        Crossing nearest;
        for (const glm::uvec3& triangle : mesh->triangles) {
            meet_triangle(ray, mesh->vertices_m[triangle.x], mesh->vertices_m[triangle.y],
                          mesh->vertices_m[triangle.z], nearest);
        }
        return nearest;
    }
};

}  // namespace

void Crossing::take_nearer(double other_range_m, const glm::dvec3& other_normal) {
    if (other_range_m < 0.0 || other_range_m >= range_m) return;
    range_m = other_range_m;
    normal = other_normal;
}

Crossing intersect(const Ray& ray, const Shape& shape) {
    return std::visit(Intersect{ray}, shape);
}

}  // namespace scipd::sim
