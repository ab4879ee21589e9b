// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reply_grid.h"

#include <gtest/gtest.h>

#include "protocol/command_table.h"
#include "protocol/ideal.h"
#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using namespace std::chrono_literals;

constexpr Grid every_25_ms{.tick = 25ms};

const Command* command(std::string_view code) {
    static DeviceProfile profile = test_profile();
    return find_command(code, profile);
}

TEST(Grid, HasNoInstantBetweenItsTicks) {
    EXPECT_EQ(every_25_ms.after(0ms), 25ms);
    EXPECT_EQ(every_25_ms.after(24'999'999ns), 25ms);
    EXPECT_EQ(every_25_ms.after(25ms), 50ms);
    EXPECT_EQ(every_25_ms.at_or_after(0ms), 0ms);
    EXPECT_EQ(every_25_ms.at_or_after(1ns), 25ms);
    EXPECT_EQ(every_25_ms.at_or_after(25ms), 25ms);
}

TEST(Grid, BeginsAtItsOrigin) {
    constexpr Grid late{.origin = 7ms, .tick = 25ms};
    EXPECT_EQ(late.after(0ms), 7ms);
    EXPECT_EQ(late.after(7ms), 32ms);
    EXPECT_EQ(late.at_or_after(7ms), 7ms);
    EXPECT_EQ(late.at_or_after(-100ms), 7ms);
}

TEST(Grid, WithoutATickNothingWaits) {
    EXPECT_EQ(Grid{}.after(7us), 7us);
    EXPECT_EQ(Grid{}.at_or_after(7us), 7us);
}

TEST(Grid, IsComputedFromTheCountAndNeverDrifts) {
    EXPECT_EQ(every_25_ms.after(1000h), 1000h + 25ms);
}

TEST(ReplyGrid, AScanLeavesAtTheTickItJustReaches) {
    const DeviceState device;
    EXPECT_EQ(scan_leaves(18'750us, device, test_profile()), 19ms);
    EXPECT_EQ(scan_leaves(19ms, device, test_profile()), 19ms);
}

TEST(ReplyGrid, OnePerTurnFollowsTheMirror) {
    DeviceProfile profile = test_profile(Family::urg);
    profile.turns_per_reply = 2;
    DeviceState device;
    device.switch_laser_on(0ms);
    EXPECT_EQ(reply_leaves(1ms, command("VV"), device, profile), 50ms);
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 25ms);
    device.settings().motor_level = 10;  // 25 ms / 0.9
    device.set_mirror_origin(75ms);
    EXPECT_EQ(reply_leaves(60ms, command("VV"), device, profile), 75ms);
    EXPECT_EQ(reply_leaves(75ms, command("VV"), device, profile), 75ms + 2 * 27'777'777ns);
}

TEST(ReplyGrid, WithTheLaserOffOnlyWhatSwitchesItOnWaitsForTheMirror) {
    DeviceProfile profile = test_profile(Family::urg);
    profile.turns_per_reply = 1;
    DeviceState device;
    for (const auto code : {"VV", "PP", "II", "QT", "RS", "GD", "TM0", "SS", "CR", "SCIP2.0"})
        EXPECT_EQ(reply_leaves(1ms, find_command(code, profile), device, profile), 2ms) << code;
    EXPECT_EQ(reply_leaves(1ms, nullptr, device, profile), 2ms);
    for (const auto code : {"BM", "MD", "MS"})
        EXPECT_EQ(reply_leaves(1ms, find_command(code, profile), device, profile), 25ms) << code;
    device.enter_adjust();  // where it is refused
    EXPECT_EQ(reply_leaves(1ms, find_command("BM", profile), device, profile), 2ms);
    // A tick that has nothing to do with the mirror is kept.
    profile.turns_per_reply = 0;
    profile.reply_tick = 5ms;
    EXPECT_EQ(reply_leaves(1ms, find_command("VV", profile), DeviceState{}, profile), 5ms);
}

TEST(ReplyGrid, TheWayOutOfScip1DoesNotWaitForTheMirror) {
    DeviceProfile profile = test_profile(Family::urg);
    profile.turns_per_reply = 1;
    DeviceState device;
    device.power_up_in_scip1(0ms);
    EXPECT_EQ(reply_leaves(1ms, nullptr, device, profile), 25ms);
    EXPECT_EQ(reply_leaves(1ms, find_command("SCIP2.0", profile), device, profile), 2ms);
    device.speak_scip2();
    device.switch_laser_on(0ms);
    EXPECT_EQ(reply_leaves(1ms, find_command("SCIP2.0", profile), device, profile), 25ms);
}

TEST(ReplyGrid, InAdjustModeTheMirrorIsNotWaitedFor) {
    DeviceProfile profile = test_profile(Family::utm_usb);
    profile.turns_per_reply = 1;
    DeviceState device;
    device.enter_adjust();
    EXPECT_EQ(reply_leaves(1ms, command("TM1"), device, profile), 2ms);
    profile.turns_per_reply = 0;
    profile.reply_tick = 25ms;
    EXPECT_EQ(reply_leaves(1ms, command("TM2"), device, profile), 2ms);
    profile.reply_tick = 0ms;
    EXPECT_EQ(reply_leaves(1ms, command("TM1"), device, profile), 1ms);
}

TEST(ReplyGrid, TimeAndScansMayHaveAWiderTickThanTheRest) {
    DeviceProfile profile = test_profile();
    profile.time_tick = profile.scan_tick = 5ms;
    DeviceState device;
    EXPECT_EQ(reply_leaves(1ms, command("TM1"), device, profile), 5ms);
    EXPECT_EQ(reply_leaves(1ms, command("TM0"), device, profile), 2ms);
    EXPECT_EQ(reply_leaves(1ms, nullptr, device, profile), 2ms);
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 20ms);
    device.enter_adjust();
    EXPECT_EQ(reply_leaves(1ms, command("TM1"), device, profile), 5ms);
    EXPECT_EQ(reply_leaves(1ms, command("TM2"), device, profile), 2ms);
}

TEST(ReplyGrid, ScansAloneMayWaitForATick) {
    DeviceProfile profile = test_profile();
    profile.reply_tick = 0ms;
    const DeviceState device;
    EXPECT_EQ(reply_leaves(300us, command("TM1"), device, profile), 300us);
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 19ms);
}

TEST(ReplyGrid, AScanMayTakeItsTime) {
    DeviceProfile profile = test_profile();
    profile.scan_delay = 4'700us;
    const DeviceState device;
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 24ms);
    profile.scan_tick = 0ms;
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 23'450us);
}

TEST(ReplyGrid, AReplyMayTakeItsTime) {
    DeviceProfile profile = test_profile();
    const DeviceState device;
    profile.state_report_delay = 2ms;
    EXPECT_EQ(reply_leaves(300us, command("II"), device, profile), 3ms);
    EXPECT_EQ(reply_leaves(300us, command("VV"), device, profile), 1ms);
    profile.reply_tick = profile.scan_tick = 0ms;
    profile.reply_delay = 500us;
    EXPECT_EQ(reply_leaves(300us, command("VV"), device, profile), 800us);
    EXPECT_EQ(reply_leaves(300us, command("II"), device, profile), 2'300us);
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 18'750us);
}

TEST(ReplyGrid, ALevelOfTheMotorIsAHundredthSlower) {
    const DeviceProfile profile = test_profile();
    EXPECT_EQ(scan_period_of({}, profile), 25ms);
    EXPECT_EQ(scan_period_of({.motor_level = 1}, profile), 25'252'525ns);
    EXPECT_EQ(scan_period_of({.motor_level = 10}, profile), 27'777'777ns);
}

TEST(ReplyGrid, AnIdealDeviceKeepsNobodyWaiting) {
    DeviceProfile profile = test_profile();
    profile.scan_period = 25'050us;
    profile.turns_per_reply = 1;
    profile.time_tick = profile.scan_tick = 5ms;
    profile.reply_delay = profile.state_report_delay = profile.scan_delay = 2ms;
    profile.settle_time = 50ms;
    profile = ideal(profile);
    const DeviceState device;
    for (const auto code : {"VV", "II", "TM1"})
        EXPECT_EQ(reply_leaves(3us, command(code), device, profile), 3us);
    EXPECT_EQ(scan_leaves(18'750us, device, profile), 18'750us);
    EXPECT_EQ(profile.scan_period, 25ms);  // 2400 rpm
    EXPECT_EQ(profile.boot_time, 0ms);
    EXPECT_EQ(profile.settle_time, 0ms);
}

}  // namespace
}  // namespace scipd::protocol
