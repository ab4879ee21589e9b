// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/frame_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

HeardPose link(const std::string& parent, const std::string& child, sim::Time time,
               const glm::dvec3& xyz_m, double yaw_rad = 0.0) {
    return {.parent = parent,
            .child = child,
            .time = time,
            .parent_from_child = sim::pose_from_rpy(xyz_m, {0.0, 0.0, yaw_rad})};
}

constexpr double quarter = 1.5707963267948966;

TEST(FrameTree, ComposesAWayThroughMovingAndFixedFrames) {
    FrameTree tree;
    tree.put(link("map", "odom", 1s, {10.0, 0.0, 0.0}, quarter), false);
    tree.put(link("odom", "base_footprint", 1s, {1.0, 0.0, 0.0}, quarter), false);
    tree.put(link("base_footprint", "base_link", 0s, {0.0, 0.0, 0.1}), true);
    const auto found = tree.find("map", "base_link");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 1s);
    // The odometry's x is the map's y.
    EXPECT_NEAR(found->parent_from_child.translation_m.x, 10.0, 1e-12);
    EXPECT_NEAR(found->parent_from_child.translation_m.y, 1.0, 1e-12);
    EXPECT_NEAR(found->parent_from_child.translation_m.z, 0.1, 1e-12);
    EXPECT_NEAR(std::abs(found->parent_from_child.rotation.z), 1.0, 1e-12);  // half a turn
}

TEST(FrameTree, KnowsThePlaceUpToTheTimeThatAllFramesReach) {
    FrameTree tree;
    tree.put(link("map", "odom", 1s, {0.0, 0.0, 0.0}), false);
    tree.put(link("odom", "base_link", 900ms, {1.0, 0.0, 0.0}), false);
    tree.put(link("odom", "base_link", 1100ms, {3.0, 0.0, 0.0}), false);
    const auto found = tree.find("map", "base_link");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 1s);
    EXPECT_NEAR(found->parent_from_child.translation_m.x, 2.0, 1e-12);
}

TEST(FrameTree, FindsAFrameBesideTheOtherOne) {
    FrameTree tree;
    tree.put(link("world", "table", 0s, {0.0, 5.0, 0.0}, quarter), true);
    tree.put(link("world", "robot", 2s, {0.0, 7.0, 0.0}), false);
    const auto found = tree.find("table", "robot");
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->parent_from_child.translation_m.x, 2.0, 1e-12);
    EXPECT_NEAR(found->parent_from_child.translation_m.y, 0.0, 1e-12);
}

TEST(FrameTree, FindsNoWayBetweenTreesAndEndsInACircle) {
    FrameTree tree;
    tree.put(link("a", "b", 0s, {}), false);
    tree.put(link("c", "d", 0s, {}), false);
    EXPECT_FALSE(tree.find("a", "d"));
    EXPECT_FALSE(tree.find("a", "nowhere"));
    tree.put(link("b", "a", 0s, {}), false);
    EXPECT_FALSE(tree.find("c", "a"));
    EXPECT_THAT(tree.names(), ElementsAre("a", "b", "c", "d"));
}

TEST(FrameTree, TakesNamesOfRos1AndAnotherParent) {
    FrameTree tree;
    tree.put(link("/odom", "/base_link", 1s, {1.0, 0.0, 0.0}), false);
    EXPECT_TRUE(tree.find("odom", "base_link"));
    tree.put(link("map", "base_link", 2s, {4.0, 0.0, 0.0}), false);
    EXPECT_FALSE(tree.find("odom", "base_link"));
    EXPECT_EQ(tree.find("map", "base_link")->parent_from_child.translation_m.x, 4.0);
}

TEST(FrameTree, FollowsASenderThatIsStartedAgain) {
    FrameTree tree;
    tree.put(link("odom", "base_link", 100s, {1.0, 0.0, 0.0}), false);
    tree.put(link("odom", "base_link", 99900ms, {0.5, 0.0, 0.0}), false);
    EXPECT_EQ(tree.find("odom", "base_link")->time, 100s) << "a packet that was overtaken";
    tree.put(link("odom", "base_link", 1s, {7.0, 0.0, 0.0}), false);
    EXPECT_EQ(tree.find("odom", "base_link")->time, 1s);
    EXPECT_EQ(tree.find("odom", "base_link")->parent_from_child.translation_m.x, 7.0);
}

}  // namespace
}  // namespace scipd::daemon
