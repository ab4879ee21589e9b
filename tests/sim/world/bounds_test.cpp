// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/bounds.h"

#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/world/scene.h"

namespace scipd::sim {
namespace {

void expect_bounds(const Bounds& bounds, const glm::dvec3& low_m, const glm::dvec3& high_m) {
    EXPECT_LT(glm::distance(bounds.low_m, low_m), 1e-9);
    EXPECT_LT(glm::distance(bounds.high_m, high_m), 1e-9);
}

TEST(Bounds, EncloseEveryShape) {
    expect_bounds(bounds_of(Box{{2, 4, 6}}), {-1, -2, -3}, {1, 2, 3});
    expect_bounds(bounds_of(Cylinder{0.5, 3}), {-0.5, -0.5, -1.5}, {0.5, 0.5, 1.5});
    expect_bounds(bounds_of(Sphere{2}), {-2, -2, -2}, {2, 2, 2});
    expect_bounds(bounds_of(Plane{{2, 4}}), {-1, -2, 0}, {1, 2, 0});
    const auto mesh =
        std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, -5}, {0, 7, 0}}, {{0, 1, 2}}});
    expect_bounds(bounds_of(mesh), {0, 0, -5}, {1, 7, 0});
}

TEST(Bounds, AreEmptyWithoutPoints) {
    EXPECT_TRUE(bounds_of(std::make_shared<const Mesh>()).empty());
    Bounds bounds;
    bounds.include(Bounds{}, Pose{});
    EXPECT_TRUE(bounds.empty());
}

TEST(Bounds, TurnWithTheirFrame) {
    Bounds bounds;
    bounds.include(bounds_of(Box{{2, 4, 6}}),
                   pose_from_rpy({10, 0, 0}, {0, 0, std::numbers::pi / 2}));
    expect_bounds(bounds, {8, -1, -3}, {12, 1, 3});
}

}  // namespace
}  // namespace scipd::sim
