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
double least_cosine(double radius_m, double tolerance_m) {
    return std::max(0.0, (radius_m - tolerance_m) / (radius_m + tolerance_m));
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
Mesh cylinder_mesh(const Cylinder& cylinder, double tolerance_m) {
    const unsigned sides = sides_for(least_cosine(cylinder.radius_m, tolerance_m));
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

/// A ring of a body that is round about z.
struct Ring {
    double radius_m;
    double z_m;
};

/// Vertices 0 and 1 are the poles; then the rings, which go from top to bottom.
Mesh round_mesh(double pole_m, const std::vector<Ring>& rings, unsigned sides) {
    const double turn = 2.0 * std::numbers::pi / sides;
    Mesh mesh;
    mesh.vertices_m = {{0.0, 0.0, pole_m}, {0.0, 0.0, -pole_m}};
    for (const Ring& ring : rings) {
        for (unsigned side = 0; side < sides; ++side) {
            mesh.vertices_m.emplace_back(ring.radius_m * std::cos(side * turn),
                                         ring.radius_m * std::sin(side * turn), ring.z_m);
        }
    }
    for (unsigned side = 0; side < sides; ++side) {
        const unsigned next = (side + 1) % sides;
        unsigned above = 2;
        mesh.triangles.emplace_back(0, above + side, above + next);
        for (std::size_t ring = 1; ring < rings.size(); ++ring, above += sides) {
            const unsigned below = above + sides;
            mesh.triangles.emplace_back(above + side, below + side, above + next);
            mesh.triangles.emplace_back(above + next, below + side, below + next);
        }
        mesh.triangles.emplace_back(1, above + next, above + side);
    }
    return mesh;
}

/// How a sphere is cut. There are half as many rings as sides, so that a piece at the equator,
/// where it is largest, is as wide as it is high. Its corner is seen from its middle under two half
/// angles, whence the squared cosine.
struct SphereCut {
    unsigned sides;  ///< a multiple of `step`
    double turn;
    double corner_radius_m;

    SphereCut(double radius_m, unsigned step, double tolerance_m = chord_tolerance_m) {
        const unsigned needed = sides_for(std::sqrt(least_cosine(radius_m, tolerance_m)));
        sides = (std::min(most_sphere_sides, needed) + step - 1) / step * step;
        turn = 2.0 * std::numbers::pi / sides;
        corner_radius_m = balanced_radius_m(radius_m, std::pow(std::cos(0.5 * turn), 2));
    }

    /// One of the rings between the poles, from the top.
    [[nodiscard]] Ring ring(unsigned index) const {
        const double down_rad = (index + 1) * turn;
        return {corner_radius_m * std::sin(down_rad), corner_radius_m * std::cos(down_rad)};
    }
};

Mesh sphere_mesh(const Sphere& sphere, double tolerance_m = chord_tolerance_m) {
    const SphereCut cut{sphere.radius_m, 2, tolerance_m};
    std::vector<Ring> rings;
    for (unsigned ring = 0; ring < cut.sides / 2 - 1; ++ring)
        rings.push_back(cut.ring(ring));
    return round_mesh(cut.corner_radius_m, rings, cut.sides);
}

struct Tessellate {
    double tolerance_m;

    Mesh operator()(const Box& box) const { return box_mesh(box); }
    Mesh operator()(const Cylinder& cylinder) const { return cylinder_mesh(cylinder, tolerance_m); }
    Mesh operator()(const Sphere& sphere) const { return sphere_mesh(sphere, tolerance_m); }
    Mesh operator()(const Plane& plane) const { return plane_mesh(plane); }
    Mesh operator()(const SharedMesh& mesh) const { return *mesh; }
};

}  // namespace

Mesh tessellate(const Shape& shape, double tolerance_m) {
    return std::visit(Tessellate{tolerance_m}, shape);
}

Mesh capsule_mesh(double radius_m, double length_m) {
    const SphereCut cut{radius_m, 4};  // so that one ring is the equator, which is there twice
    std::vector<Ring> rings;
    for (unsigned ring = 0; ring < cut.sides / 4; ++ring)
        rings.push_back(cut.ring(ring));
    const std::vector<Ring> upper = rings;
    for (Ring& ring : rings)
        ring.z_m += 0.5 * length_m;
    for (auto ring = upper.rbegin(); ring != upper.rend(); ++ring)
        rings.push_back({ring->radius_m, -ring->z_m - 0.5 * length_m});
    return round_mesh(cut.corner_radius_m + 0.5 * length_m, rings, cut.sides);
}

Mesh cone_mesh(double radius_m, double length_m) {
    // Nearer to the tip all is smaller, and so is the error.
    const unsigned sides = sides_for(least_cosine(radius_m, chord_tolerance_m));
    const double corner_radius_m = balanced_radius_m(radius_m, std::cos(std::numbers::pi / sides));
    return round_mesh(0.5 * length_m, {{corner_radius_m, -0.5 * length_m}}, sides);
}

Mesh ellipsoid_mesh(const glm::dvec3& radii_m) {
    // No axis is stretched, so that nothing lies farther off than on the sphere around it.
    const double largest_m = std::max({radii_m.x, radii_m.y, radii_m.z});
    Mesh mesh = sphere_mesh({largest_m});
    for (glm::vec3& vertex : mesh.vertices_m)
        vertex = glm::vec3{glm::dvec3{vertex} * radii_m / largest_m};
    return mesh;
}

}  // namespace scipd::sim
