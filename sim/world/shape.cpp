// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

namespace scipd::sim {
namespace {

constexpr unsigned fewest_sides = 12;
constexpr unsigned most_sphere_sides = 1024;

/// The cosine of half the angle under which a flat piece may be seen from the centre. Corners lie
/// at R and the middle of the piece at R cos: with R = 2 r / (1 + cos) one is as far outside as the
/// other is inside, r (1 - cos) / (1 + cos).
double least_cosine(double radius_m) {
    return std::max(0.0, (radius_m - chord_tolerance_m) / (radius_m + chord_tolerance_m));
}

double balanced_radius_m(double radius_m, double cosine) {
    return 2.0 * radius_m / (1.0 + cosine);
}

unsigned sides_for(double cosine) {
    return std::max(fewest_sides,
                    static_cast<unsigned>(std::ceil(std::numbers::pi / std::acos(cosine))));
}

/// Corners 0 to 7: bit 0 is +x, bit 1 +y, bit 2 +z.
Mesh box_mesh(const Box& box) {
    Mesh mesh;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side{corner & 1U ? 0.5 : -0.5, corner & 2U ? 0.5 : -0.5,
                              corner & 4U ? 0.5 : -0.5};
        mesh.vertices_m.emplace_back(side * box.size_m);
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

Mesh plane_mesh(const Plane& plane) {
    const glm::vec2 half{0.5 * plane.size_m};
    return {{{-half.x, -half.y, 0.0F},
             {half.x, -half.y, 0.0F},
             {half.x, half.y, 0.0F},
             {-half.x, half.y, 0.0F}},
            {{0, 1, 2}, {0, 2, 3}}};
}

/// Vertices 0 and 1 are the middles of the bottom and the top; then bottom and top rim in turn.
Mesh cylinder_mesh(const Cylinder& cylinder) {
    const unsigned sides = sides_for(least_cosine(cylinder.radius_m));
    const double turn = 2.0 * std::numbers::pi / sides;
    const double radius_m = balanced_radius_m(cylinder.radius_m, std::cos(0.5 * turn));
    const double top_m = 0.5 * cylinder.length_m;
    Mesh mesh;
    mesh.vertices_m = {{0.0, 0.0, -top_m}, {0.0, 0.0, top_m}};
    for (unsigned side = 0; side < sides; ++side) {
        const double x = radius_m * std::cos(side * turn);
        const double y = radius_m * std::sin(side * turn);
        mesh.vertices_m.emplace_back(x, y, -top_m);
        mesh.vertices_m.emplace_back(x, y, top_m);

        const unsigned here = 2 + 2 * side;
        const unsigned next = 2 + 2 * ((side + 1) % sides);
        mesh.triangles.insert(mesh.triangles.end(), {{0, next, here},
                                                     {1, here + 1, next + 1},
                                                     {here, next, next + 1},
                                                     {here, next + 1, here + 1}});
    }
    return mesh;
}

/// Vertices 0 and 1 are the poles; then rings from top to bottom. There are half as many rings as
/// sides, so that a piece at the equator, where it is largest, is as wide as it is high. Its corner
/// is seen from its middle under two half angles, whence the squared cosine.
Mesh sphere_mesh(const Sphere& sphere) {
    const unsigned needed = sides_for(std::sqrt(least_cosine(sphere.radius_m)));
    const unsigned half_sides = (std::min(most_sphere_sides, needed) + 1) / 2;
    const unsigned sides = 2 * half_sides;
    const unsigned rings = half_sides - 1;
    const double turn = 2.0 * std::numbers::pi / sides;
    const double radius_m = balanced_radius_m(sphere.radius_m, std::pow(std::cos(0.5 * turn), 2));
    Mesh mesh;
    mesh.vertices_m = {{0.0, 0.0, radius_m}, {0.0, 0.0, -radius_m}};
    for (unsigned ring = 0; ring < rings; ++ring) {
        const double down_rad = (ring + 1) * turn;
        for (unsigned side = 0; side < sides; ++side) {
            mesh.vertices_m.emplace_back(radius_m * std::sin(down_rad) * std::cos(side * turn),
                                         radius_m * std::sin(down_rad) * std::sin(side * turn),
                                         radius_m * std::cos(down_rad));
        }
    }
    for (unsigned side = 0; side < sides; ++side) {
        const unsigned next = (side + 1) % sides;
        unsigned above = 2;
        mesh.triangles.emplace_back(0, above + side, above + next);
        for (unsigned ring = 1; ring < rings; ++ring, above += sides) {
            const unsigned below = above + sides;
            mesh.triangles.emplace_back(above + side, below + side, above + next);
            mesh.triangles.emplace_back(above + next, below + side, below + next);
        }
        mesh.triangles.emplace_back(1, above + next, above + side);
    }
    return mesh;
}

struct Tessellate {
    Mesh operator()(const Box& box) const { return box_mesh(box); }
    Mesh operator()(const Cylinder& cylinder) const { return cylinder_mesh(cylinder); }
    Mesh operator()(const Sphere& sphere) const { return sphere_mesh(sphere); }
    Mesh operator()(const Plane& plane) const { return plane_mesh(plane); }
    Mesh operator()(const SharedMesh& mesh) const { return *mesh; }
};

}  // namespace

Mesh tessellate(const Shape& shape) {
    return std::visit(Tessellate{}, shape);
}

}  // namespace scipd::sim
