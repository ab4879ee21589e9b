// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/intersect.h"

#include <cmath>
#include <limits>
#include <memory>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double bound_m = 1e-12;

void expect_crossing(const Ray& ray, const Shape& shape, double range_m, const glm::dvec3& normal) {
    const Crossing crossing = intersect(ray, shape);
    EXPECT_NEAR(crossing.range_m, range_m, bound_m);
    // To either side.
    EXPECT_NEAR(std::abs(glm::dot(crossing.normal, normal)), 1.0, bound_m);
    EXPECT_NEAR(glm::length(crossing.normal), 1.0, bound_m);
}

void expect_nothing(const Ray& ray, const Shape& shape) {
    EXPECT_EQ(intersect(ray, shape).range_m, infinity);
}

TEST(Intersect, MeetsABoxFromOutsideAndFromWithin) {
    const Box box{{2, 4, 6}};
    expect_crossing({{-5, 0, 0}, {1, 0, 0}}, box, 4, {1, 0, 0});
    expect_crossing({{0, 0, 0}, {0, 1, 0}}, box, 2, {0, 1, 0});
    expect_crossing({{0.5, 1, 9}, {0, 0, -1}}, box, 6, {0, 0, 1});
    // From (-2, 0) at 45 degrees: the side x = -1 is met at y = 1.
    expect_crossing({{-2, 0, 0}, {std::sqrt(0.5), std::sqrt(0.5), 0}}, box, std::sqrt(2.0),
                    {1, 0, 0});
    expect_nothing({{-5, 2.001, 0}, {1, 0, 0}}, box);
    expect_nothing({{5, 0, 0}, {1, 0, 0}}, box);
}

TEST(Intersect, MeetsASphereWhereItsEquationHolds) {
    const Sphere ball{2.0};
    expect_crossing({{-5, 0, 0}, {1, 0, 0}}, ball, 3, {1, 0, 0});
    expect_crossing({{0, 0, 0}, {0, 0, 1}}, ball, 2, {0, 0, 1});
    // At half its radius beside the axis: x = -sqrt(r^2 - 1).
    expect_crossing({{-5, 1, 0}, {1, 0, 0}}, ball, 5 - std::sqrt(3.0),
                    {-std::sqrt(3.0) / 2, 0.5, 0});
    expect_nothing({{-5, 2.001, 0}, {1, 0, 0}}, ball);
}

TEST(Intersect, MeetsACylinderOnItsSideAndItsEnds) {
    const Cylinder can{1.0, 4.0};
    expect_crossing({{-3, 0, 1.9}, {1, 0, 0}}, can, 2, {1, 0, 0});
    expect_crossing({{0.5, 0.5, 5}, {0, 0, -1}}, can, 3, {0, 0, 1});
    expect_crossing({{0, 0, 0}, {0, 0, 1}}, can, 2, {0, 0, 1});
    expect_nothing({{-3, 0, 2.001}, {1, 0, 0}}, can);
    expect_nothing({{0.8, 0.8, 5}, {0, 0, -1}}, can);
}

TEST(Intersect, MeetsAPlaneWithinItsEdgesFromBothSides) {
    const Plane sheet{{2, 4}};
    expect_crossing({{0.9, 1.9, 3}, {0, 0, -1}}, sheet, 3, {0, 0, 1});
    expect_crossing({{0, 0, -3}, {0, 0, 1}}, sheet, 3, {0, 0, 1});
    expect_crossing({{0, 0, 1}, {0.6, 0, -0.8}}, sheet, 1.25, {0, 0, 1});
    expect_nothing({{1.001, 0, 3}, {0, 0, -1}}, sheet);
    expect_nothing({{0, 0, 3}, {0, 0, 1}}, sheet);
    expect_nothing({{-3, 0, 0.5}, {1, 0, 0}}, sheet);
}

TEST(Intersect, MeetsTheNearestTriangleOfAMesh) {
    auto mesh = std::make_shared<Mesh>();
    mesh->vertices_m = {{2, -1, -1}, {2, 1, -1}, {2, 0, 1}, {5, -1, -1}, {5, 1, -1}, {5, 0, 1}};
    mesh->triangles = {{3, 4, 5}, {0, 1, 2}};
    const SharedMesh shared = mesh;
    expect_crossing({{0, 0, 0}, {1, 0, 0}}, shared, 2, {1, 0, 0});
    expect_crossing({{3, 0, 0}, {1, 0, 0}}, shared, 2, {1, 0, 0});
    expect_nothing({{0, 1.5, 0}, {1, 0, 0}}, shared);
}

TEST(Pierce, TellsTheRangeAndTheSide) {
    const glm::dvec3 a{2, -1, -1};
    const glm::dvec3 b{2, 1, -1};
    const glm::dvec3 c{2, 0, 1};
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    const auto one_side = pierce(ray, a, b, c);
    const auto other_side = pierce(ray, a, c, b);
    ASSERT_TRUE(one_side && other_side);
    EXPECT_NEAR(one_side->range_m, 2.0, bound_m);
    EXPECT_NEAR(other_side->range_m, 2.0, bound_m);
    EXPECT_NE(one_side->is_back, other_side->is_back);
    EXPECT_FALSE(pierce({{0, 0, 1.1}, {1, 0, 0}}, a, b, c));
}

}  // namespace
}  // namespace scipd::sim
