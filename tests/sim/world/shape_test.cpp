// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

/// Points all over a triangle, its corners and the middles of its edges among them.
template <typename Visit>
void for_points_of(const Mesh& mesh, Visit visit) {
    constexpr int parts = 4;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a{mesh.vertices_m[triangle.x]};
        const glm::dvec3 b{mesh.vertices_m[triangle.y]};
        const glm::dvec3 c{mesh.vertices_m[triangle.z]};
        for (int i = 0; i <= parts; ++i) {
            for (int j = 0; i + j <= parts; ++j) {
                visit(a + (b - a) * (double{1} * i / parts) + (c - a) * (double{1} * j / parts));
            }
        }
    }
}

/// By the divergence theorem; right only where the surface is closed and all its triangles wind the
/// same way.
double volume_m3(const Mesh& mesh) {
    double volume = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a{mesh.vertices_m[triangle.x]};
        const glm::dvec3 b{mesh.vertices_m[triangle.y]};
        const glm::dvec3 c{mesh.vertices_m[triangle.z]};
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return std::abs(volume);
}

/// Closed: whoever walks along an edge in one triangle meets it the other way round in exactly one
/// other.
bool watertight(const Mesh& mesh) {
    std::map<std::pair<unsigned, unsigned>, int> walked;
    for (const glm::uvec3& t : mesh.triangles) {
        for (const auto& edge : {std::pair{t.x, t.y}, {t.y, t.z}, {t.z, t.x}})
            ++walked[edge];
    }
    return std::ranges::all_of(walked, [&](const auto& entry) {
        const auto back = walked.find({entry.first.second, entry.first.first});
        return entry.second == 1 && back != walked.end();
    });
}

TEST(Tessellate, MakesABoxOfTwelveTriangles) {
    const Mesh mesh = tessellate(Box{{1.0, 2.0, 3.0}});
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_NEAR(volume_m3(mesh), 6.0, 1e-6);
    EXPECT_TRUE(watertight(mesh));
    for_points_of(mesh, [](const glm::dvec3& point) {
        const glm::dvec3 share = glm::abs(point) / glm::dvec3{0.5, 1.0, 1.5};
        EXPECT_NEAR(std::max({share.x, share.y, share.z}), 1.0, 1e-6);
    });
}

TEST(Tessellate, MakesAPlaneOfItsSize) {
    const Mesh mesh = tessellate(Plane{{4.0, 6.0}});
    glm::dvec3 high{0.0};
    double area_m2 = 0.0;
    for_points_of(mesh, [&](const glm::dvec3& point) {
        EXPECT_EQ(point.z, 0.0);
        high = glm::max(high, glm::abs(point));
    });
    for (const glm::uvec3& t : mesh.triangles) {
        area_m2 += 0.5 * glm::length(glm::cross(mesh.vertices_m[t.y] - mesh.vertices_m[t.x],
                                                mesh.vertices_m[t.z] - mesh.vertices_m[t.x]));
    }
    EXPECT_EQ(high, (glm::dvec3{2.0, 3.0, 0.0}));
    EXPECT_NEAR(area_m2, 24.0, 1e-5);
}

class RoundShape : public testing::TestWithParam<double> {};

TEST_P(RoundShape, SphereStaysWithinTheToleranceOnBothSides) {
    const double radius_m = GetParam();
    const Mesh mesh = tessellate(Sphere{radius_m});
    double lowest = radius_m;
    double highest = radius_m;
    for_points_of(mesh, [&](const glm::dvec3& point) {
        lowest = std::min(lowest, glm::length(point));
        highest = std::max(highest, glm::length(point));
    });
    const double rounding_m = 1e-6 * radius_m;
    EXPECT_GE(lowest, radius_m - chord_tolerance_m - rounding_m);
    EXPECT_LE(highest, radius_m + chord_tolerance_m + rounding_m);
    EXPECT_NEAR(highest - radius_m, radius_m - lowest, 0.1 * chord_tolerance_m + rounding_m);
    EXPECT_TRUE(watertight(mesh));
}

TEST_P(RoundShape, CylinderStaysWithinTheToleranceOnBothSides) {
    const double radius_m = GetParam();
    const Mesh mesh = tessellate(Cylinder{radius_m, 2.0});
    double lowest = radius_m;
    double highest = radius_m;
    for_points_of(mesh, [&](const glm::dvec3& point) {
        EXPECT_LE(std::abs(point.z), 1.0);
        const double around_m = std::hypot(point.x, point.y);
        highest = std::max(highest, around_m);
        if (std::abs(point.z) < 0.9) lowest = std::min(lowest, around_m);
    });
    const double rounding_m = 1e-6 * radius_m;
    EXPECT_GE(lowest, radius_m - chord_tolerance_m - rounding_m);
    EXPECT_LE(highest, radius_m + chord_tolerance_m + rounding_m);
    EXPECT_TRUE(watertight(mesh));
}

TEST_P(RoundShape, HasNearlyTheVolumeOfTheTrueOne) {
    const double r = GetParam();
    const double layer_m = 2.0 * chord_tolerance_m;
    const double pi = std::numbers::pi;
    EXPECT_NEAR(volume_m3(tessellate(Sphere{r})), 4.0 / 3.0 * pi * r * r * r,
                4.0 * pi * r * r * layer_m);
    EXPECT_NEAR(volume_m3(tessellate(Cylinder{r, 2.0})), 2.0 * pi * r * r, 4.0 * pi * r * layer_m);
}

TEST_P(RoundShape, CapsuleStaysWithinTheToleranceOnBothSides) {
    const double radius_m = GetParam();
    const Mesh mesh = capsule_mesh(radius_m, 3.0);
    double lowest = radius_m;
    double highest = radius_m;
    for_points_of(mesh, [&](const glm::dvec3& point) {
        // The distance from the stretch of the axis between the half spheres.
        const glm::dvec3 nearest{0.0, 0.0, std::clamp(point.z, -1.5, 1.5)};
        lowest = std::min(lowest, glm::length(point - nearest));
        highest = std::max(highest, glm::length(point - nearest));
    });
    const double rounding_m = 1e-6 * radius_m;
    EXPECT_GE(lowest, radius_m - chord_tolerance_m - rounding_m);
    EXPECT_LE(highest, radius_m + chord_tolerance_m + rounding_m);
    EXPECT_TRUE(watertight(mesh));
    const double volume = std::numbers::pi * radius_m * radius_m * (4.0 / 3.0 * radius_m + 3.0);
    EXPECT_NEAR(volume_m3(mesh), volume, 0.01 * volume + 1e-3 * radius_m);
}

INSTANTIATE_TEST_SUITE_P(Radii, RoundShape, testing::Values(0.02, 0.25, 1.0, 5.0));

TEST(Tessellate, SpendsNoMoreTrianglesThanTheToleranceAsksFor) {
    EXPECT_LT(tessellate(Cylinder{0.5, 1.0}).triangles.size(), 500U);
    EXPECT_LT(tessellate(Sphere{0.1}).triangles.size(), 6'000U);
    EXPECT_LE(tessellate(Sphere{1000.0}).triangles.size(), 1'100'000U);
}

TEST(Tessellate, LeavesMeshesAlone) {
    const auto mesh =
        std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const Mesh same = tessellate(mesh);
    EXPECT_EQ(same.vertices_m, mesh->vertices_m);
    EXPECT_EQ(same.triangles, mesh->triangles);
}

TEST(Ellipsoid, HasItsThreeRadiiAndItsVolume) {
    const Mesh mesh = ellipsoid_mesh({0.5, 1.0, 2.0});
    EXPECT_TRUE(watertight(mesh));
    EXPECT_NEAR(volume_m3(mesh), 4.0 / 3.0 * std::numbers::pi, 1e-3);
    for_points_of(mesh, [](const glm::dvec3& point) {
        const glm::dvec3 share = point / glm::dvec3{0.5, 1.0, 2.0};
        EXPECT_NEAR(glm::length(share), 1.0, chord_tolerance_m / 0.5);
    });
}

}  // namespace
}  // namespace scipd::sim
