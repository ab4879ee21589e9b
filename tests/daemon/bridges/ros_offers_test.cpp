// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/bridges/ros_offers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using ::testing::HasSubstr;

constexpr const char* odometry = "nav_msgs::msg::dds_::Odometry_";
constexpr const char* scan = "sensor_msgs::msg::dds_::LaserScan_";

TEST(RosOffers, TakesWhatAllWhoPublishCanDo) {
    RosOffers offers;
    EXPECT_TRUE(offers.add("a", {"/odom", odometry, true, true}));
    EXPECT_FALSE(offers.add("a", {"/odom", odometry, true, true}));
    EXPECT_TRUE(offers.common("/odom")->reliable);
    EXPECT_TRUE(offers.add("b", {"/odom", odometry, false, false}));
    EXPECT_FALSE(offers.common("/odom")->reliable);
    EXPECT_FALSE(offers.common("/odom")->keeps_last);
    EXPECT_TRUE(offers.remove("b"));
    EXPECT_FALSE(offers.remove("b"));
    EXPECT_TRUE(offers.common("/odom")->reliable);
}

TEST(RosOffers, TellsWhyNothingCanCome) {
    RosOffers offers;
    EXPECT_EQ(offers.trouble_with("/odom"), "no publisher of /odom; there are no topics");
    offers.add("a", {"/robot_1/odometry", odometry, true, true});
    offers.add("b", {"/scan", scan, true, true});
    EXPECT_EQ(offers.trouble_with("/odom"),
              "no publisher of /odom; topics there are /robot_1/odometry");
    EXPECT_EQ(offers.trouble_with("/robot_2/odometry"),
              "no publisher of /robot_2/odometry; did you mean '/robot_1/odometry'?");
    EXPECT_THAT(offers.trouble_with("/scan"), HasSubstr("/scan is of sensor_msgs/LaserScan"));
    EXPECT_FALSE(offers.common("/scan"));
    EXPECT_EQ(offers.trouble_with("/robot_1/odometry"), "");
}

}  // namespace
}  // namespace scipd::daemon
