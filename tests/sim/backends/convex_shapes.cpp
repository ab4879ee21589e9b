// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/sim/backends/convex_shapes.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

const Box box{{1.0, 2.0, 0.6}};
const Cylinder cylinder{0.7, 1.6};
const Sphere sphere{0.9};
const Plane plane{{3.0, 2.0}};
constexpr double octahedron_m = 1.25;  ///< from the middle to a corner
constexpr double inner = 0.95;         ///< how far out to aim, so that no edge is near

SurfacePoint on_box(Rng& rng) {
    const int axis = std::uniform_int_distribution<int>(0, 2)(rng);
    const double side = rng() % 2 == 0 ? 1.0 : -1.0;
    glm::dvec3 point{uniform(rng, -inner, inner), uniform(rng, -inner, inner),
                     uniform(rng, -inner, inner)};
    glm::dvec3 normal{0.0};
    point[axis] = normal[axis] = side;
    return {0.5 * point * box.size_m, normal};
}

SurfacePoint on_cylinder(Rng& rng) {
    const double angle_rad = uniform(rng, 0.0, 2.0 * std::numbers::pi);
    const glm::dvec3 outward{std::cos(angle_rad), std::sin(angle_rad), 0.0};
    const double half_m = 0.5 * cylinder.length_m;
    if (rng() % 2 == 0) {
        const glm::dvec3 height{0.0, 0.0, uniform(rng, -inner, inner) * half_m};
        return {cylinder.radius_m * outward + height, outward};
    }
    const double end = rng() % 2 == 0 ? 1.0 : -1.0;
    const double radius_m = uniform(rng, 0.0, inner) * cylinder.radius_m;
    return {radius_m * outward + glm::dvec3{0.0, 0.0, end * half_m}, {0.0, 0.0, end}};
}

SurfacePoint on_sphere(Rng& rng) {
    const glm::dvec3 outward = random_direction(rng);
    return {sphere.radius_m * outward, outward};
}

SurfacePoint on_plane(Rng& rng) {
    const glm::dvec2 point{uniform(rng, -inner, inner), uniform(rng, -inner, inner)};
    return {{0.5 * point * plane.size_m, 0.0}, {0.0, 0.0, rng() % 2 == 0 ? 1.0 : -1.0}};
}

SurfacePoint on_octahedron(Rng& rng) {
    const glm::dvec3 octant{rng() % 2 == 0 ? 1.0 : -1.0, rng() % 2 == 0 ? 1.0 : -1.0,
                            rng() % 2 == 0 ? 1.0 : -1.0};
    glm::dvec3 weights{uniform(rng, 0.02, 1.0), uniform(rng, 0.02, 1.0), uniform(rng, 0.02, 1.0)};
    weights /= weights.x + weights.y + weights.z;
    return {octahedron_m * weights * octant, glm::normalize(octant)};
}

SharedMesh octahedron() {
    constexpr auto r = static_cast<float>(octahedron_m);
    return std::make_shared<const Mesh>(Mesh{
        {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}});
}

}  // namespace

double uniform(Rng& rng, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
}

glm::dvec3 random_direction(Rng& rng) {
    const double z = uniform(rng, -1.0, 1.0);
    const double angle_rad = uniform(rng, 0.0, 2.0 * std::numbers::pi);
    const double flat = std::sqrt(1.0 - z * z);
    return {flat * std::cos(angle_rad), flat * std::sin(angle_rad), z};
}

Pose random_pose(Rng& rng, double reach_m) {
    return {reach_m * random_direction(rng),
            glm::angleAxis(uniform(rng, 0.0, 2.0 * std::numbers::pi), random_direction(rng))};
}

std::vector<ConvexShape> convex_shapes() {
    return {{"box", box, on_box, true},
            {"cylinder", cylinder, on_cylinder, true},
            {"sphere", sphere, on_sphere, true},
            {"plane", plane, on_plane, false},
            {"mesh", octahedron(), on_octahedron, true}};
}

}  // namespace scipd::sim
