// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/poses/heard_meaning.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

HeardPose named(const std::string& name, sim::Time time, double x_m, std::uint64_t id = 0) {
    HeardPose pose{.parent = {}, .child = name, .id = id, .time = time, .parent_from_child = {}};
    pose.parent_from_child.translation_m.x = x_m;
    return pose;
}

Heard poses_of(std::vector<HeardPose> poses) {
    return {.type = "gz.msgs.Pose_V", .poses = std::move(poses)};
}

class GzMeaningTest : public testing::Test {
  protected:
    GzMeaningTest() : world_(wall_world()) {}

    World world_;
};

TEST_F(GzMeaningTest, MovesTheRobotByItsNameOrByAnother) {
    const auto by_name = make_gz_meaning("");
    const auto said = by_name->take(poses_of({named("other", 1s, 9.0), named("robot", 1s, 1.0)}),
                                    "robot", world_);
    ASSERT_EQ(said.lines.size(), 1U);
    EXPECT_EQ(said.until, 1s);
    EXPECT_EQ(said.lines[0].robot, "robot");
    EXPECT_EQ(said.lines[0].pose.translation_m.x, 1.0);
    const auto called = make_gz_meaning("rescue");
    EXPECT_EQ(called->take(poses_of({named("rescue", 1s, 2.0)}), "robot", world_)
                  .lines[0]
                  .pose.translation_m.x,
              2.0);
}

TEST_F(GzMeaningTest, FindsALinkOfAModel) {
    const auto meaning = make_gz_meaning("rescue::base_link");
    // As dynamic_pose/info has it: all models, then all links with their places in their models.
    const auto said =
        meaning->take(poses_of({named("cart", 1s, 5.0, 8), named("rescue", 1s, 1.0, 20),
                                named("base_link", 1s, 0.5, 9), named("base_link", 1s, 0.25, 21)}),
                      "robot", world_);
    ASSERT_EQ(said.lines.size(), 1U);
    EXPECT_DOUBLE_EQ(said.lines[0].pose.translation_m.x, 1.25);
    // A topic that has the whole name needs no such thing.
    EXPECT_DOUBLE_EQ(meaning->take(poses_of({named("rescue::base_link", 2s, 7.0)}), "robot", world_)
                         .lines[0]
                         .pose.translation_m.x,
                     7.0);
}

TEST_F(GzMeaningTest, TellsTheNearestNamesOfARobotThatIsNotThere) {
    const auto meaning = make_gz_meaning("rescu");
    EXPECT_TRUE(meaning->troubles("robot", world_).empty());
    (void)meaning->take(poses_of({named("rescue", 1s, 1.0)}), "robot", world_);
    EXPECT_THAT(meaning->troubles("robot", world_),
                ElementsAre("Gazebo names no 'rescu'; did you mean 'rescue'?"));
}

TEST_F(GzMeaningTest, PutsAModelThatHasRestedWhereItWasUntilItMoves) {
    const auto meaning = make_gz_meaning("");
    const auto lines = [&](sim::Time time, double x_m) {
        const auto said = meaning->take(poses_of({named("model 1", time, x_m)}), "robot", world_);
        for (const sim::PoseLine& line : said.lines)
            EXPECT_TRUE(world_.place_model("model 1", {*line.time, line.pose}));
        return said.lines.size();
    };
    EXPECT_EQ(lines(1s, 1.0), 0U) << "another feed moves models";
    meaning->move_models(true);
    EXPECT_EQ(lines(1s, 1.0), 1U);
    EXPECT_EQ(lines(1100ms, 1.0), 0U);
    EXPECT_EQ(lines(1200ms, 1.0), 0U);
    EXPECT_EQ(lines(1300ms, 2.0), 2U);
    EXPECT_EQ(world_.model("model 1")->at(1200ms).translation_m.x, 1.0);
    EXPECT_DOUBLE_EQ(world_.model("model 1")->at(1250ms).translation_m.x, 1.5);
}

}  // namespace
}  // namespace scipd::daemon
