// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/world.h"

#include <gtest/gtest.h>

#include "sim/backends/fan.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

sim::Pose at_x(double x_m) {
    return sim::pose_from_rpy({x_m, 0, 0}, {0, 0, 0});
}

class WorldTest : public testing::Test {
  protected:
    [[nodiscard]] double robot_x(sim::Time time) const {
        return world_.robot("robot")->at(time).translation_m.x;
    }

    World world_ = wall_world();
};

TEST_F(WorldTest, MovesARobotEvenlyBetweenPosesThatFollowClosely) {
    EXPECT_FALSE(world_.place_robot("robot", 10s, at_x(1)));
    EXPECT_FALSE(world_.place_robot("robot", 10500ms, at_x(2)));
    EXPECT_DOUBLE_EQ(robot_x(9s), 0.0);
    EXPECT_DOUBLE_EQ(robot_x(10s), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(10250ms), 1.5);
    EXPECT_DOUBLE_EQ(robot_x(11s), 2.0);
}

TEST_F(WorldTest, LetsARobotRestBetweenPosesThatAreFarApart) {
    EXPECT_FALSE(world_.place_robot("robot", 10s, at_x(1)));
    EXPECT_FALSE(world_.place_robot("robot", 12s, at_x(5)));
    EXPECT_DOUBLE_EQ(robot_x(11999ms), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(12s), 5.0);
}

TEST_F(WorldTest, SaysWhyAPoseIsRefused) {
    EXPECT_EQ(world_.place_robot("nobody", 1s, at_x(1)),
              "robot: there is no \"nobody\"; robots are robot");
    EXPECT_EQ(world_.place_model("model 0", 1s, at_x(1)),
              "model: there is no movable \"model 0\"; movable models are model 1");
    EXPECT_FALSE(world_.place_robot("robot", 1s, at_x(1)));
    EXPECT_EQ(world_.place_robot("robot", 1s, at_x(2)), "t: not later than the pose before it");
    EXPECT_DOUBLE_EQ(robot_x(2s), 1.0);
}

TEST_F(WorldTest, TakesAPoseWithoutANameForTheOnlyRobot) {
    EXPECT_FALSE(world_.place_only_robot(1s, at_x(3)));
    EXPECT_DOUBLE_EQ(robot_x(1s), 3.0);
    world_.set_robots({{"robot", at_x(0)}, {"second", at_x(1)}});
    EXPECT_EQ(world_.place_only_robot(2s, at_x(4)), "robot: say which; robots are robot, second");
}

TEST_F(WorldTest, KeepsRobotsWhereTheyAreUnlessTheirStartIsAnother) {
    EXPECT_FALSE(world_.place_robot("robot", 1s, at_x(3)));
    world_.set_robots({{"robot", at_x(0)}, {"second", at_x(1)}});
    EXPECT_DOUBLE_EQ(robot_x(2s), 3.0);
    world_.set_robots({{"robot", at_x(7)}});
    EXPECT_DOUBLE_EQ(robot_x(2s), 7.0);
    EXPECT_EQ(world_.robot("second"), nullptr);
}

TEST_F(WorldTest, ShowsMovableModelsWhereTheyAreAtThatTime) {
    const auto ahead_m = [&](sim::Time time) {
        const sim::Pose here;
        const glm::vec3 ahead(1, 0, 0);
        sim::Hit hit;
        world_.backend_at("auto", time)
            .cast({.directions = {&ahead, 1}, .world_from_sensor = {&here, 1}, .max_range_m = 50},
                  {&hit, 1});
        return hit.range_m;
    };
    EXPECT_FLOAT_EQ(ahead_m(0s), 4.0F);
    EXPECT_FALSE(world_.place_model("model 1", 1s, at_x(2.5)));
    EXPECT_FALSE(world_.place_model("model 1", 2s, at_x(3.5)));
    EXPECT_FLOAT_EQ(ahead_m(1s), 2.0F);
    EXPECT_FLOAT_EQ(ahead_m(1500ms), 2.5F);
    EXPECT_FLOAT_EQ(ahead_m(3s), 3.0F);
    // Back in time too: each scanner asks for its own.
    EXPECT_FLOAT_EQ(ahead_m(500ms), 4.0F);
}

TEST_F(WorldTest, NamesTheBackendThatAutoStandsFor) {
    EXPECT_EQ(world_.backend_name("auto"), "embree");
}

}  // namespace
}  // namespace scipd::daemon
