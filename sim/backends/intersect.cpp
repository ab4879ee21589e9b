// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/intersect.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// The stretch of a ray that lies within a convex body. The body is what several simple ones have
/// in common, so the ray is clipped by each of them, and no ray slips through where two faces meet.
class Inside {
  public:
    explicit Inside(const Ray& ray) : ray_(ray) {}

    /// |x| <= half along one axis.
    void clip_slab(int axis, double half_m) {
        glm::dvec3 normal{0.0};
        normal[axis] = 1.0;
        const double along = ray_.direction[axis];
        if (along == 0.0) {
            if (std::abs(ray_.origin_m[axis]) > half_m) nowhere();
            return;
        }
        const double middle_m = -ray_.origin_m[axis] / along;
        const double reach_m = half_m / std::abs(along);
        clip({middle_m - reach_m, normal}, {middle_m + reach_m, normal});
    }

    /// |x| <= radius, over the axes where `axes` is 1.
    void clip_round(const glm::dvec3& axes, double radius_m) {
        const glm::dvec3 origin_m = axes * ray_.origin_m;
        const glm::dvec3 direction = axes * ray_.direction;
        const double a = glm::dot(direction, direction);
        const double b = glm::dot(origin_m, direction);
        const double c = glm::dot(origin_m, origin_m) - radius_m * radius_m;
        if (a == 0.0) {
            if (c > 0.0) nowhere();
            return;
        }
        const double discriminant = b * b - a * c;
        if (discriminant < 0.0) return nowhere();
        const double root = std::sqrt(discriminant);
        const auto crossing = [&](double range_m) {
            return Crossing{range_m, (origin_m + range_m * direction) / radius_m};
        };
        clip(crossing((-b - root) / a), crossing((-b + root) / a));
    }

    /// Where the ray enters, or where it leaves if it begins inside.
    [[nodiscard]] Crossing first() const {
        if (enter_.range_m > leave_.range_m || leave_.range_m < 0.0) return {};
        return enter_.range_m >= 0.0 ? enter_ : leave_;
    }

  private:
    void clip(const Crossing& enter, const Crossing& leave) {
        if (enter.range_m > enter_.range_m) enter_ = enter;
        if (leave.range_m < leave_.range_m) leave_ = leave;
    }
    void nowhere() { enter_.range_m = std::numeric_limits<double>::infinity(); }

    const Ray& ray_;
    Crossing enter_{-std::numeric_limits<double>::infinity(), {}};
    Crossing leave_{};
};

void meet_triangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   Crossing& nearest) {
    const auto piercing = pierce(ray, a, b, c);
    if (!piercing || piercing->range_m >= nearest.range_m) return;
    nearest = {piercing->range_m, glm::normalize(glm::cross(b - a, c - a))};
}

struct Intersect {
    const Ray& ray;

    Crossing operator()(const Box& box) const {
        Inside inside(ray);
        for (int axis = 0; axis < 3; ++axis)
            inside.clip_slab(axis, 0.5 * box.size_m[axis]);
        return inside.first();
    }

    Crossing operator()(const Cylinder& cylinder) const {
        Inside inside(ray);
        inside.clip_round({1.0, 1.0, 0.0}, cylinder.radius_m);
        inside.clip_slab(2, 0.5 * cylinder.length_m);
        return inside.first();
    }

    Crossing operator()(const Sphere& sphere) const {
        Inside inside(ray);
        inside.clip_round({1.0, 1.0, 1.0}, sphere.radius_m);
        return inside.first();
    }

    Crossing operator()(const Plane& plane) const {
        if (ray.direction.z == 0.0) return {};
        const double range_m = -ray.origin_m.z / ray.direction.z;
        const glm::dvec3 share =
            (ray.origin_m + range_m * ray.direction) / glm::dvec3{0.5 * plane.size_m, 1.0};
        if (range_m < 0.0 || std::abs(share.x) > 1.0 || std::abs(share.y) > 1.0) return {};
        return {range_m, {0.0, 0.0, 1.0}};
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

// Moeller and Trumbore: Fast, minimum storage ray/triangle intersection, 1997.
std::optional<Piercing> pierce(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return std::nullopt;
    const glm::dvec3 from_a = ray.origin_m - a;
    const double u = glm::dot(from_a, p) / determinant;
    if (!(u >= 0.0 && u <= 1.0)) return std::nullopt;
    const glm::dvec3 q = glm::cross(from_a, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    if (!(v >= 0.0 && u + v <= 1.0)) return std::nullopt;
    const double range_m = glm::dot(ac, q) / determinant;
    if (range_m < 0.0) return std::nullopt;
    return Piercing{range_m, determinant < 0.0};
}

Crossing intersect(const Ray& ray, const Shape& shape) {
    return std::visit(Intersect{ray}, shape);
}

}  // namespace scipd::sim
