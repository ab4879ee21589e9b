// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_triangles.h"

#include <cmath>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/sim/backends/convex_shapes.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

Pose at(double x, double y = 0.0, double z = 0.0) {
    return {{x, y, z}, Pose{}.rotation};
}

double area_of(const DepthTriangles& triangles, ObjectId object) {
    double area = 0.0;
    for (TriangleId id = 0; id < triangles.triangles().size(); ++id) {
        if (triangles.faces()[id].object != object) continue;
        const glm::uvec3 corners = triangles.triangles()[id].corners;
        const auto place = [&](std::uint32_t i) {
            return glm::dvec3{triangles.vertices()[i].position_m};
        };
        area += 0.5 * glm::length(glm::cross(place(corners.y) - place(corners.x),
                                             place(corners.z) - place(corners.x)));
    }
    return area;
}

TEST(DepthTriangles, HasAllTrianglesOfAllObjects) {
    const SharedScene scene = SceneBuilder()
                                  .add(Box{{1, 2, 3}}, at(5))
                                  .add(Plane{{4, 5}}, at(-5))
                                  .movable(at(9))
                                  .with(Sphere{1.0}, {})
                                  .build();
    const DepthTriangles triangles(*scene);
    EXPECT_NEAR(area_of(triangles, 0), 22.0, 1e-4);
    EXPECT_NEAR(area_of(triangles, 1), 20.0, 1e-4);
    EXPECT_NEAR(area_of(triangles, 2), 4.0 * M_PI, 0.01);
}

TEST(DepthTriangles, GivesEachTriangleAFirstCornerOfItsOwn) {
    const SharedScene scene =
        SceneBuilder().add(Box{{1, 2, 3}}, at(5)).add(Sphere{2.0}, at(-5)).build();
    const DepthTriangles triangles(*scene);
    std::set<std::uint32_t> firsts;
    for (TriangleId id = 0; id < triangles.triangles().size(); ++id) {
        const glm::uvec3 corners = triangles.triangles()[id].corners;
        EXPECT_TRUE(firsts.insert(corners.x).second);
        EXPECT_EQ(triangles.vertices()[corners.x].triangle, id);
    }
    // Not many more corners than it takes: parts of a large mesh share none.
    EXPECT_LT(triangles.vertices().size(), triangles.triangles().size() * 12 / 10 + 20);
}

TEST(DepthTriangles, IsRelativeToTheAnchor) {
    SceneBuilder builder(at(5'000'000, 400'000, 100));
    const SharedScene scene = builder.add(Box{{1, 1, 1}}, at(1)).build();
    const DepthTriangles triangles(*scene);
    for (const DrawnVertex& vertex : triangles.vertices())
        EXPECT_NEAR(glm::length(glm::dvec3{vertex.position_m}), std::sqrt(0.75), 1e-6);
}

TEST(DepthTriangles, MovesTheVerticesOfOneModelOnly) {
    const SharedScene scene = SceneBuilder()
                                  .movable({})
                                  .with(Box{{1, 1, 1}}, at(3))
                                  .with(Box{{1, 1, 1}}, at(-3))
                                  .movable({})
                                  .with(Box{{1, 1, 1}}, {})
                                  .build();
    DepthTriangles triangles(*scene);
    const std::vector<DrawnVertex> before(triangles.vertices().begin(), triangles.vertices().end());
    const Pose turned = at(10, 0, 1) * pose_from_rpy({0, 0, 0}, {0, 0, M_PI});
    const VertexRange moved = triangles.move(0, turned);
    EXPECT_EQ(moved.first, 0U);
    EXPECT_EQ(moved.count, before.size() * 2 / 3);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const glm::dvec3 was{before[i].position_m};
        const glm::dvec3 expected = i < moved.count ? turned * was : was;
        EXPECT_LT(glm::distance(glm::dvec3{triangles.vertices()[i].position_m}, expected), 1e-5);
    }
    EXPECT_EQ(triangles.move(1, at(5)).count, before.size() / 3);
}

TEST(DepthTriangles, MovesNothingOfAModelWithoutGeometry) {
    DepthTriangles triangles(*SceneBuilder().movable({}).build());
    EXPECT_EQ(triangles.move(0, at(5)).count, 0U);
}

// Leaves out what it can, and never a triangle that is seen: of boxes and spheres, seen from
// outside, those that face the eye.
TEST(DepthTriangles, CollectsWhatAStripSees) {
    Rng rng(8);
    SceneBuilder builder;
    for (int i = 0; i < 100; ++i)
        builder.add(Box{{0.5, 0.5, 0.5}}, random_pose(rng, 20.0));
    builder.add(Sphere{3.0}, at(-5, 5));
    const SharedScene scene = builder.build();
    DepthTriangles triangles(*scene);
    const Strip strip{.first = {-1.0, -0.1}, .pitch = {2e-3, 2e-3}, .size_px = {1001, 101}};
    std::size_t collected = 0;
    std::size_t seen = 0;
    for (int look = 0; look < 50; ++look) {
        const Pose pose = random_pose(rng, 5.0);
        std::vector<DrawnTriangle> drawn;
        triangles.collect(Frustum(strip, pose), no_model, drawn);
        std::set<std::uint32_t> first_corners;
        for (const DrawnTriangle& triangle : drawn)
            first_corners.insert(triangle.corners.x);
        collected += drawn.size();
        for (const DrawnTriangle& triangle : triangles.triangles()) {
            const auto corner = [&](int i) {
                return inverse(pose) *
                       glm::dvec3{triangles.vertices()[triangle.corners[i]].position_m};
            };
            const glm::dvec3 middle = (corner(0) + corner(1) + corner(2)) / 3.0;
            const glm::dvec3 outward = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
            const glm::dvec2 pixel = pixel_of(strip, glm::normalize(middle));
            const bool before = middle.x > 0.0 && glm::dot(outward, middle) < 0.0;
            if (!before || pixel.x < 0.0 || pixel.x > 1000.0 || pixel.y < 0.0 || pixel.y > 100.0)
                continue;
            ++seen;
            EXPECT_TRUE(first_corners.contains(triangle.corners.x));
        }
    }
    EXPECT_GT(seen, 20U);
    EXPECT_LT(collected, 50 * triangles.triangles().size() / 10);
}

}  // namespace
}  // namespace scipd::sim
