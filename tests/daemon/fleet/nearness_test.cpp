// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who is near, against distances.
#include "daemon/fleet/nearness.h"

#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

sim::PoseLine model_at(double x_m, double y_m, const std::string& model = "m") {
    return {.model = model, .pose = {{x_m, y_m, 0.0}}};
}

TEST(Nearness, LeavesOutNothingNearAndMostThatIsFar) {
    std::mt19937 chance(7);
    std::uniform_real_distribution<double> anywhere_m(-500.0, 500.0);
    std::vector<glm::dvec3> robots_m(5);
    for (glm::dvec3& robot_m : robots_m)
        robot_m = {anywhere_m(chance), anywhere_m(chance), 0.0};
    Nearness nearness(60.0);
    ASSERT_TRUE(nearness.look_around(robots_m).empty());
    int far = 0;
    int left_out = 0;
    for (int i = 0; i < 2000; ++i) {
        const sim::PoseLine line = model_at(anywhere_m(chance), anywhere_m(chance));
        const auto closer = [&](double limit_m) {
            return std::ranges::any_of(robots_m, [&](const glm::dvec3& robot_m) {
                return glm::distance(robot_m, line.pose.translation_m) < limit_m;
            });
        };
        (void)nearness.matters(model_at(0.0, 1e4));  // it is far now, wherever it was
        const bool taken = nearness.matters(line);
        if (closer(60.0)) {
            EXPECT_TRUE(taken);
        }
        if (!closer(2.0 * 60.0 * 1.4143)) {
            EXPECT_FALSE(taken);
        }
        far += closer(60.0) ? 0 : 1;
        left_out += taken ? 0 : 1;
    }
    EXPECT_GT(left_out, far / 2);
}

TEST(Nearness, SeesModelsLeaveAndIsToldWhereTheyStandWhenARobotComes) {
    Nearness nearness(10.0);
    ASSERT_TRUE(nearness.look_around({{0.0, 0.0, 0.0}}).empty());
    EXPECT_TRUE(nearness.matters(model_at(5.0, 0.0)));
    EXPECT_TRUE(nearness.matters(model_at(50.0, 0.0)));
    EXPECT_FALSE(nearness.matters(model_at(60.0, 0.0)));
    EXPECT_FALSE(nearness.matters(model_at(70.0, 0.0)));
    EXPECT_EQ(nearness.far(), 1U);
    EXPECT_TRUE(nearness.look_around({{20.0, 0.0, 0.0}}).empty());
    const auto back = nearness.look_around({{65.0, 0.0, 0.0}});
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].pose.translation_m.x, 70.0);
    EXPECT_EQ(nearness.far(), 0U);
}

}  // namespace
}  // namespace scipd::daemon
