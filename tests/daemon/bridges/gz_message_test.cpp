// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/gz_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/bridges/gz_bytes.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using namespace scipd::tests;
using ::testing::HasSubstr;

TEST(GzMessage, ReadsPosesOfEitherGeneration) {
    const std::string bytes = gz_poses(2500ms, {{"crate", 8, 1.0, 2.0}, {"lid", 9, 0.0, 0.5}});
    for (const char* const type : {"gz.msgs.Pose_V", "ignition.msgs.Pose_V"}) {
        const auto heard = read_gz_message(type, bytes);
        ASSERT_TRUE(heard) << heard.error().why;
        ASSERT_EQ(heard->poses.size(), 2U);
        EXPECT_EQ(heard->poses[0].child, "crate");
        EXPECT_EQ(heard->poses[0].id, 8U);
        EXPECT_EQ(heard->poses[0].time, 2500ms);
        EXPECT_EQ(heard->poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 0.0));
        EXPECT_EQ(heard->poses[1].child, "lid");
    }
}

TEST(GzMessage, ReadsAPoseOfItsOwnAndTheClock) {
    const auto pose = read_gz_message("gz.msgs.Pose", gz_header(7s) + gz_pose({"robot", 1, 3.0}));
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->poses[0].child, "robot");
    EXPECT_EQ(pose->poses[0].time, 7s);
    const std::string sim_time = gz_integer(1, 4) + gz_integer(2, 1);
    const auto clock = read_gz_message("gz.msgs.Clock", gz_within(4, sim_time));
    ASSERT_TRUE(clock);
    EXPECT_EQ(clock->clock, 4s + 1ns);
}

TEST(GzMessage, TakesOdometryForWhoeverTheTopicIsOf) {
    const std::string bytes = gz_header(7s) + gz_within(2, gz_pose({"rescue/odom", 1, 3.0}));
    const auto heard = read_gz_message("gz.msgs.Odometry", bytes);
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->poses[0].child, "");
    EXPECT_EQ(heard->poses[0].time, 7s);
}

TEST(GzMessage, RefusesWhatIsDamaged) {
    const std::string bytes = gz_poses(2500ms, {{"crate", 8, 1.0, 2.0}});
    // A field that ends elsewhere than the message is damage; between two fields nobody can tell.
    EXPECT_FALSE(read_gz_message("gz.msgs.Pose_V", bytes.substr(0, bytes.size() - 1)));
    EXPECT_FALSE(read_gz_message("gz.msgs.Pose_V", "\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff"));
    EXPECT_THAT(read_gz_message("gz.msgs.LaserScan", "").error().why, HasSubstr("holds no pose"));
    const std::string no_rotation = gz_within(2, "crate") + gz_numbers(5, {0.0, 0.0, 0.0, 0.0});
    EXPECT_THAT(read_gz_message("gz.msgs.Pose", no_rotation).error().why,
                HasSubstr("pose of 'crate' must have a quaternion of length 1"));
}

}  // namespace
}  // namespace scipd::daemon
