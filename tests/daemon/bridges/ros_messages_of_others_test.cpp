// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages that ROS 2 itself has written, as others have published them with what they say.
#include <chrono>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "daemon/bridges/ros_cdr.h"
#include "tests/daemon/bridges/hex_bytes.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using scipd::tests::hex_bytes;

// A message of /tf beside turtlesim, recorded on 2021-12-06. From src/MessageReader.test.ts of
// github.com/foxglove/rosmsg2-serialization.
const std::string of_turtlesim = hex_bytes(
    "00010000 01000000 286fae61 69ddd731 08000000 747572746c653100 0e000000"
    "747572746c65315f616865616400 000000000000"
    "000000000000f03f 0000000000000000 0000000000000000"
    "0000000000000000 0000000000000000 0000000000000000 000000000000f03f");

TEST(RosMessagesOfOthers, TransformsThatWereRecorded) {
    const auto heard = read_ros_message("tf2_msgs/TFMessage", of_turtlesim);
    ASSERT_TRUE(heard) << heard.error().why;
    ASSERT_EQ(heard->poses.size(), 1U);
    const HeardPose& pose = heard->poses.front();
    EXPECT_EQ(pose.time, 1638821672s + 836230505ns);
    EXPECT_EQ(pose.parent, "turtle1");
    EXPECT_EQ(pose.child, "turtle1_ahead");
    EXPECT_EQ(pose.parent_from_child, sim::Pose({.translation_m = {1.0, 0.0, 0.0}}));
}

// Fast DDS writes into buffers that it has used before, and padding keeps what was there: "link"
// behind "odom", in a message of rclpy.
TEST(RosMessagesOfOthers, PaddingMayHoldAnything) {
    std::string used = of_turtlesim;
    used.replace(used.find("ahead") + 6, 6, "link\0\x0c", 6);
    const auto heard = read_ros_message("tf2_msgs/TFMessage", used);
    ASSERT_TRUE(heard) << heard.error().why;
    EXPECT_EQ(heard->poses.front().child, "turtle1_ahead");
    EXPECT_EQ(heard->poses.front().parent_from_child.translation_m.x, 1.0);
}

// What rclpy makes of a message with rmw_cyclonedds: "map", x 1.5, y -2.25, yaw 1, and 0.1 six
// times in the covariance. From test/test_cdr.cpp of github.com/evshary/autoware_manual_control.
TEST(RosMessagesOfOthers, APoseAsRclpyWritesIt) {
    std::string message = hex_bytes(
        "00010000 07000000 08000000 04000000 6d617000"
        "000000000000f83f 00000000000002c0 0000000000000000"
        "0000000000000000 0000000000000000 f0054b74e8aede3f 507d5b062815ec3f");
    for (int i = 0; i < 36; ++i)
        message += hex_bytes(i % 7 == 0 ? "9a9999999999b93f" : "0000000000000000");
    const auto heard = read_ros_message("geometry_msgs/PoseWithCovarianceStamped", message);
    ASSERT_TRUE(heard) << heard.error().why;
    ASSERT_EQ(heard->poses.size(), 1U);
    const HeardPose& pose = heard->poses.front();
    EXPECT_EQ(pose.time, 7s + 8ns);
    EXPECT_EQ(pose.parent, "map");
    EXPECT_EQ(pose.parent_from_child.translation_m, glm::dvec3(1.5, -2.25, 0.0));
    const sim::Pose turned = sim::pose_from_rpy({}, {0.0, 0.0, 1.0});
    EXPECT_LT(sim::angle_between_rad(pose.parent_from_child.rotation, turned.rotation), 1e-7);
}

}  // namespace
}  // namespace scipd::daemon
