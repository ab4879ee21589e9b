// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/ros_cdr.h"

#include <bit>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/daemon/bridges/hex_bytes.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using namespace std::string_literals;
using scipd::tests::hex_bytes;
using ::testing::HasSubstr;

const std::string seven_numbers = hex_bytes(
    "000000000000f03f 0000000000000040 0000000000000840"
    "0000000000000000 0000000000000000 0000000000000000 000000000000f03f");

// As the specification has it: a header that says little endian, then sec 2, nanosec 500000000,
// the five bytes of "odom", seven of padding, and seven doubles: 1 2 3, 0 0 0 1.
const std::string pose_stamped =
    hex_bytes("00010000 02000000 0065cd1d 05000000 6f646f6d00 00000000000000") + seven_numbers;
constexpr std::size_t x_at = 28;
constexpr std::size_t w_at = x_at + 6 * 8;

TEST(RosCdr, ReadsAPoseByteByByte) {
    const auto heard = read_ros_message("geometry_msgs/PoseStamped", pose_stamped);
    ASSERT_TRUE(heard) << heard.error().why;
    ASSERT_EQ(heard->poses.size(), 1U);
    EXPECT_EQ(heard->poses[0].parent, "odom");
    EXPECT_EQ(heard->poses[0].child, "");
    EXPECT_EQ(heard->poses[0].time, 2500ms);
    EXPECT_EQ(heard->poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 3.0));
}

// There doubles stand at multiples of four: three bytes of padding.
TEST(RosCdr, ReadsTheSecondFormOfCdr) {
    const std::string second =
        hex_bytes("00070000 02000000 0065cd1d 05000000 6f646f6d00 000000") + seven_numbers;
    const auto heard = read_ros_message("geometry_msgs/PoseStamped", second);
    ASSERT_TRUE(heard) << heard.error().why;
    EXPECT_EQ(heard->poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 3.0));
    std::string listed = second;
    listed[1] = 3;  // a list of parameters, which no type of ROS is
    EXPECT_FALSE(read_ros_message("geometry_msgs/PoseStamped", listed));
}

TEST(RosCdr, TakesNoTimeWhereNobodyHasSetOne) {
    std::string unset = pose_stamped;
    unset.replace(4, 8, 8, '\0');
    const auto heard = read_ros_message("geometry_msgs/PoseStamped", unset);
    ASSERT_TRUE(heard);
    EXPECT_FALSE(heard->poses[0].time);
}

TEST(RosCdr, RefusesEveryMessageThatIsCutAnywhere) {
    for (std::size_t size = 0; size < pose_stamped.size(); ++size)
        EXPECT_FALSE(read_ros_message("geometry_msgs/PoseStamped", pose_stamped.substr(0, size)))
            << size;
}

TEST(RosCdr, RefusesWhatIsNoRotationAndNoPlace) {
    const auto why = [](std::size_t at, double value) {
        std::string changed = pose_stamped;
        const auto raw = std::bit_cast<std::array<char, 8>>(value);
        changed.replace(at, 8, raw.data(), 8);
        const auto heard = read_ros_message("geometry_msgs/PoseStamped", changed);
        return heard ? "taken" : heard.error().why;
    };
    EXPECT_THAT(why(w_at, 0.0), HasSubstr("must have a quaternion of length 1"));
    EXPECT_THAT(why(w_at, std::nan("")), HasSubstr("must have a quaternion of length 1"));
    EXPECT_THAT(why(x_at, std::nan("")), HasSubstr("must lie within 1e7 m of the origin"));
    EXPECT_THAT(why(x_at, 2e7), HasSubstr("must lie within 1e7 m of the origin"));
    EXPECT_EQ(why(w_at, 1.001), "taken");
}

TEST(RosCdr, RefusesATextThatIsLongerThanItsMessage) {
    std::string wrong = pose_stamped;
    wrong.replace(12, 4, hex_bytes("ffffffff"));
    EXPECT_FALSE(read_ros_message("geometry_msgs/PoseStamped", wrong));
    const std::string many = hex_bytes("00010000 ffffffff");
    EXPECT_FALSE(read_ros_message("tf2_msgs/TFMessage", many));
}

// Messages of Fast DDS have in their padding what was in its buffer before, a child frame that
// nobody set is an empty text, and 36 numbers follow each pose and each twist: so the bags of
// rosbag2 have them that people print.
TEST(RosCdr, ReadsOdometryWithLeftoversInItsPadding) {
    const std::string begin = hex_bytes("00010000 02000000 0065cd1d 05000000 6f646f6d00 6c696e");
    const std::string rest = std::string(8 * (36 + 6 + 36), '\0');
    const auto of = [&](const char* child) {
        return read_ros_message("nav_msgs/Odometry",
                                begin + hex_bytes(child) + seven_numbers + rest);
    };
    const auto unnamed = of("01000000 00 ffffffe4202020");
    ASSERT_TRUE(unnamed) << unnamed.error().why;
    ASSERT_EQ(unnamed->poses.size(), 1U);
    EXPECT_EQ(unnamed->poses[0].parent, "odom");
    EXPECT_EQ(unnamed->poses[0].child, "");
    EXPECT_EQ(unnamed->poses[0].time, 2500ms);
    EXPECT_EQ(unnamed->poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 3.0));
    const auto named = of("0a000000 626173655f6c696e6b00 656c");
    EXPECT_FALSE(named) << "it lacks four bytes of padding";
    const auto padded = of("0a000000 626173655f6c696e6b00 656c0c080000");
    ASSERT_TRUE(padded) << padded.error().why;
    EXPECT_EQ(padded->poses[0].child, "base_link");
    EXPECT_EQ(padded->poses[0].parent_from_child.translation_m, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(RosCdr, ReadsTheClock) {
    const auto heard =
        read_ros_message("rosgraph_msgs/Clock", hex_bytes("00010000 03000000 01000000"));
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->clock, 3s + 1ns);
    EXPECT_TRUE(heard->poses.empty());
}

TEST(RosCdr, KnowsTypesByTheirNamesInDds) {
    EXPECT_EQ(ros_type_of("nav_msgs::msg::dds_::Odometry_"), "nav_msgs/Odometry");
    EXPECT_EQ(ros_type_of("HelloWorld"), "HelloWorld");
}

}  // namespace
}  // namespace scipd::daemon
