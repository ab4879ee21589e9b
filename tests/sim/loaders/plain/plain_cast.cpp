// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/sim/loaders/plain/plain_world.h"

namespace scipd::tests {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Ray {
    glm::dvec3 from;
    glm::dvec3 along;

    [[nodiscard]] glm::dvec3 at(double t) const { return from + t * along; }
};

/// The smaller of the solutions of a t^2 + 2 b t + c = 0 that lies ahead and is `well`.
template <typename Well>
double first_root(double a, double b, double c, Well well) {
    const double discriminant = b * b - a * c;
    if (a <= 0.0 || discriminant < 0.0) return never;
    for (const double t :
         {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
        if (t > 0.0 && well(t)) return t;
    }
    return never;
}

/// Where the ray meets the plane in which this coordinate has this value, if that is `well`.
template <typename Well>
double at_level(const Ray& ray, int axis, double level, Well well) {
    const double t = (level - ray.from[axis]) / ray.along[axis];
    return std::isfinite(t) && t > 0.0 && well(ray.at(t)) ? t : never;
}

struct RangeTo {
    Ray ray;

    double operator()(const PlainSphere& sphere) const {
        return first_root(1.0, glm::dot(ray.from, ray.along),
                          glm::dot(ray.from, ray.from) - sphere.radius_m * sphere.radius_m,
                          [](double) { return true; });
    }

    double operator()(const PlainBox& box) const {
        double nearest = never;
        for (int axis = 0; axis < 3; ++axis) {
            const auto on_face = [&](const glm::dvec3& p) {
                const int u = (axis + 1) % 3;
                const int v = (axis + 2) % 3;
                return std::abs(p[u]) <= box.half_m[u] && std::abs(p[v]) <= box.half_m[v];
            };
            for (const double side : {-1.0, 1.0})
                nearest = std::min(nearest, at_level(ray, axis, side * box.half_m[axis], on_face));
        }
        return nearest;
    }

    double operator()(const PlainCylinder& cylinder) const {
        const double square = cylinder.radius_m * cylinder.radius_m;
        const glm::dvec2 from{ray.from};
        const glm::dvec2 along{ray.along};
        double nearest =
            first_root(glm::dot(along, along), glm::dot(from, along), glm::dot(from, from) - square,
                       [&](double t) { return std::abs(ray.at(t).z) <= cylinder.half_length_m; });
        for (const double side : {-1.0, 1.0}) {
            nearest = std::min(
                nearest, at_level(ray, 2, side * cylinder.half_length_m, [&](const glm::dvec3& p) {
                    return p.x * p.x + p.y * p.y <= square;
                }));
        }
        return nearest;
    }

    double operator()(const PlainRectangle& plane) const {
        return at_level(ray, 2, 0.0, [&](const glm::dvec3& p) {
            return std::abs(p.x) <= plane.half_m.x && std::abs(p.y) <= plane.half_m.y;
        });
    }

    double operator()(const PlainTriangles& triangles) const {
        double nearest = never;
        for (const auto& [a, b, c] : triangles) {
            // from + t along = a + u (b - a) + v (c - a), by Cramer's rule
            const glm::dmat3 m{-ray.along, b - a, c - a};
            const double whole = glm::determinant(m);
            if (whole == 0.0) continue;
            const glm::dvec3 solution = glm::inverse(m) * (ray.from - a);
            const bool inside =
                solution.y >= 0.0 && solution.z >= 0.0 && solution.y + solution.z <= 1.0;
            if (inside && solution.x > 0.0) nearest = std::min(nearest, solution.x);
        }
        return nearest;
    }
};

}  // namespace

std::optional<double> plain_range_m(const PlainWorld& world, const glm::dvec3& from_m,
                                    const glm::dvec3& direction) {
    double nearest = never;
    for (const PlainThing& thing : world) {
        const glm::dmat4 thing_from_world = glm::inverse(thing.world_from_thing);
        const Ray ray{glm::dvec3{thing_from_world * glm::dvec4{from_m, 1.0}},
                      glm::dmat3{thing_from_world} * direction};
        nearest = std::min(nearest, std::visit(RangeTo{ray}, thing.shape));
    }
    return nearest < never ? std::optional{nearest} : std::nullopt;
}

}  // namespace scipd::tests
