// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sim/sensor/beam_pattern.h"

namespace scipd::sim {
namespace {

constexpr double right_angle_rad = std::numbers::pi / 2;

// By hand: from -1 to 1 in four columns, from -0.5 to 0.5 in two rows, at x = 1.
TEST(PinholeGrid, IsEvenInTangentsRowByRowFromTheUpperLeft) {
    const PinholeGrid grid{4, 2, right_angle_rad, 2 * std::atan(0.5)};
    const double y[] = {0.75, 0.25, -0.25, -0.75};
    const double z[] = {0.25, -0.25};
    const auto directions = grid.directions();
    ASSERT_EQ(directions.size(), 8U);
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 4; ++column) {
            const double length = std::sqrt(1.0 + y[column] * y[column] + z[row] * z[row]);
            const glm::vec3& direction = directions[static_cast<std::size_t>(row * 4 + column)];
            EXPECT_NEAR(direction.x, 1.0 / length, 1e-7);
            EXPECT_NEAR(direction.y, y[column] / length, 1e-7);
            EXPECT_NEAR(direction.z, z[row] / length, 1e-7);
        }
    }
}

TEST(PinholeGrid, HasItsMiddlePixelOnTheAxis) {
    const auto directions = PinholeGrid{3, 5, 1.0, 0.5}.directions();
    EXPECT_EQ(directions[7], glm::vec3(1, 0, 0));
    EXPECT_EQ((PinholeGrid{1, 1, 1.0, 1.0}.directions()), std::vector{glm::vec3(1, 0, 0)});
}

}  // namespace
}  // namespace scipd::sim
