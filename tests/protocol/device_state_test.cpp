// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/device_state.h"

#include <gtest/gtest.h>

#include "protocol/timestamp.h"

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

TEST(DeviceState, ItsClockCanBeSetUntilRsOrBoot) {
    DeviceState device;
    device.set_clock(5s, 16'777'000ms);
    EXPECT_EQ(timestamp_ms(5s, device.clock_zero()), 16'777'000U);
    EXPECT_EQ(timestamp_ms(5s + 216ms, device.clock_zero()), 0U);
    device.reset(6s);
    EXPECT_EQ(timestamp_ms(6s, device.clock_zero()), 0U);
    device.set_clock(7s, 16'777'000ms);
    device.boot(8s, 1s);
    EXPECT_EQ(timestamp_ms(8s, device.clock_zero()), 0U);
}

TEST(DeviceState, AMirrorBeginsAnewWithABoot) {
    DeviceState device;
    EXPECT_EQ(device.mirror_origin(), 0s);
    device.set_mirror_origin(3s);
    device.partial_reset(4s);
    EXPECT_EQ(device.mirror_origin(), 3s);
    device.boot(8s, 1s);
    EXPECT_EQ(device.mirror_origin(), 8s);
}

TEST(DeviceState, BootsAsIfNew) {
    DeviceState device;
    const auto stream = device.open_stream(1ms);
    device.set_trouble(Trouble::abnormal);
    device.settings().motor_level = 3;
    device.boot(1s, 5s);
    EXPECT_EQ(device.boots(), 1);
    EXPECT_FALSE(device.streams(stream));
    EXPECT_FALSE(device.laser_on());
    EXPECT_FALSE(device.failed());
    EXPECT_EQ(device.settings(), Settings{});
    EXPECT_EQ(device.clock_zero(), 1s);
    EXPECT_TRUE(device.booting(6s - 1ns));
    EXPECT_FALSE(device.booting(6s));
    EXPECT_NE(device.open_stream(7s), stream);
}

TEST(DeviceState, RebootsASecondAfterTheSecondRequest) {
    DeviceState device;
    EXPECT_FALSE(device.ask_reboot(1s, 5s));
    EXPECT_FALSE(device.ask_reboot(2s + 1ns, 5s));
    EXPECT_TRUE(device.ask_reboot(3s, 5s));
    EXPECT_EQ(device.reboots_at(), 4s);
    device.advance(4s - 1ns);
    EXPECT_EQ(device.boots(), 0);
    device.advance(9s);  // late: it booted when it should have
    EXPECT_EQ(device.boots(), 1);
    EXPECT_EQ(device.booted_at(), 9s);
    EXPECT_EQ(device.reboots_at(), std::nullopt);
    EXPECT_FALSE(device.ask_reboot(10s, 5s));
}

TEST(DeviceState, AsleepItHasNoLaserAndWakesSlowly) {
    DeviceState device;
    device.switch_laser_on(1ms);
    device.sleep();
    EXPECT_TRUE(device.asleep());
    EXPECT_FALSE(device.laser_on());
    device.wake(1s, 3s);
    device.switch_laser_on(1s);
    EXPECT_FALSE(device.asleep());
    EXPECT_TRUE(device.waking(4s - 1ns));
    EXPECT_FALSE(device.waking(4s));
    EXPECT_EQ(device.laser_on_since(), 4s);
    device.wake(10s, 3s);  // it is awake
    EXPECT_FALSE(device.waking(11s));
}

TEST(DeviceState, APartialResetKeepsSpeedAndRate) {
    DeviceState device;
    device.settings() = {.bit_rate = 57600, .motor_level = 4, .sensitive = true};
    device.partial_reset(1s);
    EXPECT_EQ(device.settings(), (Settings{.bit_rate = 57600, .motor_level = 4}));
    EXPECT_EQ(device.clock_zero(), 1s);
    device.reset(2s);
    EXPECT_EQ(device.settings(), Settings{});
}

}  // namespace
}  // namespace scipd::protocol
