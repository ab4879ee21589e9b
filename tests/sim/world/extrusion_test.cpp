// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/extrusion.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

const Outline square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const Outline hole{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
const Outline island{{1.5, 1.5}, {2.5, 1.5}, {2, 2.5}};

/// The area of all triangles that lie level at this height.
double area_at(const Mesh& mesh, float z) {
    double area_m2 = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto& a = mesh.vertices_m[t.x];
        const auto& b = mesh.vertices_m[t.y];
        const auto& c = mesh.vertices_m[t.z];
        if (a.z == z && b.z == z && c.z == z) {
            area_m2 += 0.5 * glm::length(glm::cross(glm::dvec3{b - a}, glm::dvec3{c - a}));
        }
    }
    return area_m2;
}

double area_of_walls(const Mesh& mesh) {
    double area_m2 = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a{mesh.vertices_m[t.x]};
        const glm::dvec3 b{mesh.vertices_m[t.y]};
        const glm::dvec3 c{mesh.vertices_m[t.z]};
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (normal.z == 0.0) area_m2 += 0.5 * glm::length(normal);
    }
    return area_m2;
}

TEST(Extrusion, StandsOnTheGround) {
    const Mesh mesh = extrusion_mesh({square}, 2.5);
    EXPECT_NEAR(area_at(mesh, 0.0F), 16.0, 1e-6);
    EXPECT_NEAR(area_at(mesh, 2.5F), 16.0, 1e-6);
    EXPECT_NEAR(area_of_walls(mesh), 16.0 * 2.5, 1e-6);
}

TEST(Extrusion, OutlinesWithinEachOtherTakeTurns) {
    EXPECT_NEAR(area_at(extrusion_mesh({square, hole}, 1.0), 1.0F), 12.0, 1e-6);
    EXPECT_NEAR(area_at(extrusion_mesh({hole, square, island}, 1.0), 1.0F), 12.5, 1e-6);
    EXPECT_NEAR(area_of_walls(extrusion_mesh({square, hole}, 1.0)), 24.0, 1e-6);
}

TEST(Extrusion, MayBeConcaveAndRunEitherWay) {
    // An arrow head: the square less the triangle below its tip.
    const Outline arrow{{0, 0}, {2, 3}, {4, 0}, {2, 4}};
    const Outline back{arrow.rbegin(), arrow.rend()};
    EXPECT_NEAR(area_at(extrusion_mesh({arrow}, 1.0), 1.0F), 2.0, 1e-6);
    EXPECT_NEAR(area_at(extrusion_mesh({back}, 1.0), 0.0F), 2.0, 1e-6);
}

}  // namespace
}  // namespace scipd::sim
