// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/sensor/beam_pattern.h"

namespace scipd::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;

double off_axis_rad(const glm::vec3& direction) {
    return std::acos(std::clamp(double{direction.x}, -1.0, 1.0));
}

TEST(BeamCone, GoesFromTheAxisToTheRim) {
    for (const double opening : {1.0, 30.0, 90.0, 180.0}) {
        const auto directions = BeamCone{opening * degree, 61}.directions();
        ASSERT_EQ(directions.size(), 61U);
        EXPECT_EQ(directions.front(), glm::vec3(1, 0, 0));
        EXPECT_NEAR(off_axis_rad(directions.back()), 0.5 * opening * degree, 1e-4);
        for (std::size_t i = 1; i < directions.size(); ++i) {
            EXPECT_NEAR(glm::length(directions[i]), 1.0, 1e-6);
            EXPECT_GE(off_axis_rad(directions[i]), off_axis_rad(directions[i - 1]) - 1e-4);
        }
    }
    EXPECT_EQ((BeamCone{0.5, 1}.directions()), std::vector{glm::vec3(1, 0, 0)});
}

// As many as the solid angle of the smaller cone has a share of, and none far from its neighbour.
TEST(BeamCone, IsFilledEvenly) {
    constexpr int beams = 500;
    const double rim_rad = 40 * degree;
    const auto directions = BeamCone{2 * rim_rad, beams}.directions();
    for (const double part : {0.2, 0.4, 0.6, 0.8}) {
        const double share = (1 - std::cos(part * rim_rad)) / (1 - std::cos(rim_rad));
        const auto within = std::ranges::count_if(
            directions, [&](const auto& u) { return off_axis_rad(u) <= part * rim_rad; });
        EXPECT_NEAR(double(within), share * beams, 2.0) << part;
    }
    const double spacing =
        std::sqrt(2 * std::numbers::pi * (1 - std::cos(rim_rad)) / double(beams));
    glm::dvec3 sum{0.0};
    for (const glm::vec3& direction : directions) {
        double nearest = 2.0;
        for (const glm::vec3& other : directions) {
            if (other != direction)
                nearest = std::min(nearest, double{glm::distance(direction, other)});
        }
        EXPECT_GT(nearest, 0.5 * spacing);
        EXPECT_LT(nearest, 1.5 * spacing);
        sum += glm::dvec3{direction};
    }
    EXPECT_NEAR(sum.y / beams, 0.0, 0.01);
    EXPECT_NEAR(sum.z / beams, 0.0, 0.01);
}

}  // namespace
}  // namespace scipd::sim
