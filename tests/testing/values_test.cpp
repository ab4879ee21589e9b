// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "testing/pose_json.h"

namespace {

using namespace scipd::testing;

TEST(PoseBetween, IsOnTheShortWayRound) {
    const Json from = json_of({0, 0, 3.0});
    const Json to = json_of({2, -1, -3.0});
    const Pose half = pose_in(between(from, to, 0.5));
    EXPECT_NEAR(half.x_m, 1, 1e-12);
    EXPECT_NEAR(half.y_m, -0.5, 1e-12);
    EXPECT_NEAR(std::abs(half.yaw_rad), std::numbers::pi, 1e-9);
    EXPECT_NEAR(pose_in(between(from, to, 0.25)).yaw_rad, 3.0 + 0.25 * (2 * std::numbers::pi - 6),
                1e-9);
    EXPECT_NEAR(pose_in(between(from, to, 1)).yaw_rad, -3.0, 1e-9);
    EXPECT_NEAR(pose_in(between(from, from, 0.7)).yaw_rad, 3.0, 1e-9);
}

TEST(ScanWithoutRanges, HasNoNearest) {
    const Scan scan{.ranges_m = {std::nullopt, std::nullopt}, .angles_rad = {0.0, 0.1}};
    EXPECT_FALSE(scan.nearest());
    EXPECT_FALSE(scan.at(0.05));
    EXPECT_THROW((void)scan.at(0.3), std::out_of_range);
    EXPECT_THROW((void)Scan().at(0), std::out_of_range);
}

}  // namespace
