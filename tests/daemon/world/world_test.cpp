// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/world.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "sim/backends/fan.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/one_backend.h"
#include "tests/support/why_not.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using tests::why_not;

sim::Pose at_x(double x_m) {
    return sim::pose_from_rpy({x_m, 0, 0}, {0, 0, 0});
}

class WorldTest : public testing::Test {
  protected:
    [[nodiscard]] double robot_x(sim::Time time) const {
        return world_.robot("robot")->at(time).translation_m.x;
    }

    float ahead_m(sim::Time time) {
        const sim::Pose here;
        const glm::vec3 ahead(1, 0, 0);
        sim::Hit hit;
        sim::RangeBackend& backend = world_.backend("robot/scanner");
        for (const sim::Mover& mover : world_.movers().all(time, time, sim::no_model))
            backend.move(mover.id, mover.path->at(time));
        backend.cast(
            {.directions = {&ahead, 1}, .world_from_sensor = {&here, 1}, .max_range_m = 50},
            {&hit, 1});
        return hit.range_m;
    }

    World world_ = wall_world();
};

TEST_F(WorldTest, MovesARobotEvenlyBetweenPosesThatFollowClosely) {
    EXPECT_TRUE(world_.place_robot("robot", {10s, at_x(1)}));
    EXPECT_TRUE(world_.place_robot("robot", {10500ms, at_x(2)}));
    EXPECT_DOUBLE_EQ(robot_x(9s), 0.0);
    EXPECT_DOUBLE_EQ(robot_x(10s), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(10250ms), 1.5);
    EXPECT_DOUBLE_EQ(robot_x(11s), 2.0);
}

TEST_F(WorldTest, LetsARobotRestBetweenPosesThatAreFarApart) {
    EXPECT_TRUE(world_.place_robot("robot", {10s, at_x(1)}));
    EXPECT_TRUE(world_.place_robot("robot", {12s, at_x(5)}));
    EXPECT_DOUBLE_EQ(robot_x(11999ms), 1.0);
    EXPECT_DOUBLE_EQ(robot_x(12s), 5.0);
}

TEST_F(WorldTest, SaysWhyAPoseIsRefused) {
    EXPECT_EQ(why_not(world_.place_robot("nobody", {1s, at_x(1)})),
              "robot: there is no \"nobody\"; robots are robot");
    EXPECT_EQ(why_not(world_.place_model("model 0", {1s, at_x(1)})),
              "model: there is no movable \"model 0\"; movable models are model 1");
    EXPECT_TRUE(world_.place_robot("robot", {1s, at_x(1)}));
    const Placed late = world_.place_robot("robot", {1s, at_x(2)});
    EXPECT_EQ(why_not(late), "t: not later than the pose before it");
    EXPECT_EQ(late.error().reason, NotPlaced::Reason::not_later);
    EXPECT_EQ(late.error().field, "t");
    EXPECT_DOUBLE_EQ(robot_x(2s), 1.0);
}

// Each refused line of a stream is answered with such a sentence.
TEST_F(WorldTest, NamesSomeOfManyWhereAPoseIsRefused) {
    std::map<std::string, RobotStart> robots;
    for (int i = 100; i < 120; ++i)
        robots[std::to_string(i)] = {at_x(0)};
    world_.set_robots(robots);
    EXPECT_EQ(why_not(world_.place_only_robot({1s, at_x(1)})),
              "robot is missing; robots are 100, 101, 102, 103, 104, 105, 106, 107, 108, 109, 110, "
              "111, 112, 113, 114, 115 and 4 more");
}

TEST_F(WorldTest, TakesAPoseWithoutANameForTheOnlyRobot) {
    EXPECT_TRUE(world_.place_only_robot({1s, at_x(3)}));
    EXPECT_DOUBLE_EQ(robot_x(1s), 3.0);
    world_.set_robots({{"robot", {at_x(0)}}, {"second", {at_x(1)}}});
    EXPECT_EQ(why_not(world_.place_only_robot({2s, at_x(4)})),
              "robot is missing; robots are robot, second");
}

TEST_F(WorldTest, KeepsRobotsWhereTheyAreUnlessTheirStartIsAnother) {
    EXPECT_TRUE(world_.place_robot("robot", {1s, at_x(3)}));
    world_.set_robots({{"robot", {at_x(0)}}, {"second", {at_x(1)}}});
    EXPECT_DOUBLE_EQ(robot_x(2s), 3.0);
    world_.set_robots({{"robot", {at_x(7)}}});
    EXPECT_DOUBLE_EQ(robot_x(2s), 7.0);
    EXPECT_EQ(world_.robot("second"), nullptr);
}

TEST_F(WorldTest, ShowsMovableModelsWhereTheyAreAtThatTime) {
    EXPECT_FLOAT_EQ(ahead_m(0s), 4.0F);
    EXPECT_TRUE(world_.place_model("model 1", {1s, at_x(2.5)}));
    EXPECT_TRUE(world_.place_model("model 1", {2s, at_x(3.5)}));
    EXPECT_FLOAT_EQ(ahead_m(1s), 2.0F);
    EXPECT_FLOAT_EQ(ahead_m(1500ms), 2.5F);
    EXPECT_FLOAT_EQ(ahead_m(3s), 3.0F);
    // Back in time too: each scanner asks for its own.
    EXPECT_FLOAT_EQ(ahead_m(500ms), 4.0F);
}

TEST_F(WorldTest, MovesABodyWithItsRobotAndNotOtherwise) {
    EXPECT_EQ(world_.body_of("robot"), sim::no_model);
    world_.set_robots({{"robot", {.body = "model 1"}}});
    EXPECT_EQ(world_.body_of("robot"), 1U);
    EXPECT_TRUE(world_.place_robot("robot", {1s, at_x(3)}));
    EXPECT_DOUBLE_EQ(world_.model("model 1")->at(1s).translation_m.x, 3.0);
    EXPECT_EQ(why_not(world_.place_model("model 1", {2s, at_x(1)})),
              "model: \"model 1\" is the body of a robot; move the robot");
    // A scene of the same kind, and a robot that has lost its body.
    world_.set_robots({{"robot", {}}});
    EXPECT_EQ(world_.body_of("robot"), sim::no_model);
    EXPECT_TRUE(world_.place_model("model 1", {2s, at_x(1)}));
}

TEST_F(WorldTest, KnowsWhetherPosesAreStillToCome) {
    EXPECT_TRUE(world_.poses_known(1s));  // nobody has sent any
    EXPECT_TRUE(world_.place_robot("robot", {1s, at_x(1)}));
    EXPECT_TRUE(world_.poses_known(1s));
    EXPECT_FALSE(world_.poses_known(1100ms));
    EXPECT_TRUE(world_.poses_known(1600ms));  // a stream that has ended
    EXPECT_TRUE(world_.place_robot("robot", {1200ms, at_x(1)}));
    EXPECT_TRUE(world_.poses_known(1100ms));
}

TEST_F(WorldTest, TellsWhenSomethingHasBeenPlaced) {
    int told = 0;
    world_.on_placed([&] { ++told; });
    EXPECT_TRUE(world_.place_robot("robot", {1s, at_x(1)}));
    EXPECT_FALSE(world_.place_robot("robot", {1s, at_x(1)}));
    EXPECT_EQ(told, 1);
}

TEST_F(WorldTest, KeepsModelsWhereTheyAreInASceneThatHasThemToo) {
    EXPECT_TRUE(world_.place_model("model 1", {1s, at_x(2.5)}));
    const sim::SharedScene scene = world_.scene();
    world_.replace_scene(scene, one_backend(scene));
    EXPECT_DOUBLE_EQ(world_.model("model 1")->at(1s).translation_m.x, 2.5);
}

// As at the start, when others follow those that were there at once.
TEST_F(WorldTest, ShowsOtherBackendsWhereModelsAreNow) {
    EXPECT_TRUE(world_.place_model("model 1", {1s, at_x(2.5)}));
    const float before_m = ahead_m(1s);
    world_.replace_backends(one_backend(world_.scene()));
    EXPECT_EQ(ahead_m(1s), before_m);
}

}  // namespace
}  // namespace scipd::daemon
