// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/device_state.h"

#include <gtest/gtest.h>

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

TEST(DeviceState, BeginsWithTheLaserOff) {
    const DeviceState device;
    EXPECT_FALSE(device.laser_on());
    EXPECT_FALSE(device.adjusting());
    EXPECT_EQ(device.clock_zero(), 0ms);
}

TEST(DeviceState, RemembersWhenTheLaserWentOnFirst) {
    DeviceState device;
    device.switch_laser_on(5ms);
    device.switch_laser_on(9ms);
    EXPECT_EQ(device.laser_on_since(), 5ms);
    device.open_stream(12ms);
    EXPECT_EQ(device.laser_on_since(), 5ms);
}

TEST(DeviceState, TheLaserGoesOffWithTheLastStream) {
    DeviceState device;
    const auto a = device.open_stream(1ms);
    const auto b = device.open_stream(2ms);
    EXPECT_NE(a, b);
    device.close_stream(a);
    EXPECT_TRUE(device.laser_on());
    EXPECT_FALSE(device.streams(a));
    EXPECT_TRUE(device.streams(b));
    device.close_stream(b);
    EXPECT_FALSE(device.laser_on());
}

TEST(DeviceState, AStreamsEndTakesTheLaserThatBmSwitchedOn) {
    DeviceState device;
    device.switch_laser_on(1ms);
    device.close_stream(device.open_stream(2ms));
    EXPECT_FALSE(device.laser_on());
}

TEST(DeviceState, ClosingAStreamTwiceChangesNothing) {
    DeviceState device;
    const auto stream = device.open_stream(1ms);
    device.close_stream(stream);
    device.switch_laser_on(2ms);
    device.close_stream(stream);
    device.close_stream(0);
    EXPECT_TRUE(device.laser_on());
}

TEST(DeviceState, StopLeavesOtherStreamsTheirLaser) {
    DeviceState device;
    const auto stream = device.open_stream(1ms);
    device.stop();
    EXPECT_TRUE(device.laser_on());
    device.close_stream(stream);
    device.switch_laser_on(2ms);
    device.stop();
    EXPECT_FALSE(device.laser_on());
}

TEST(DeviceState, AdjustModeEndsStreamsAndLaser) {
    DeviceState device;
    const auto stream = device.open_stream(1ms);
    device.enter_adjust();
    EXPECT_TRUE(device.adjusting());
    EXPECT_FALSE(device.laser_on());
    EXPECT_FALSE(device.streams(stream));
    device.leave_adjust();
    EXPECT_FALSE(device.adjusting());
    EXPECT_FALSE(device.laser_on());
}

TEST(DeviceState, ResetEndsEverythingAndSetsTheClockToZero) {
    DeviceState device;
    const auto stream = device.open_stream(1ms);
    device.reset(30ms);
    EXPECT_FALSE(device.laser_on());
    EXPECT_FALSE(device.streams(stream));
    EXPECT_EQ(device.clock_zero(), 30ms);
    EXPECT_NE(device.open_stream(31ms), stream);
    device.enter_adjust();
    device.reset(40ms);
    EXPECT_FALSE(device.adjusting());
}

}  // namespace
}  // namespace scipd::protocol
