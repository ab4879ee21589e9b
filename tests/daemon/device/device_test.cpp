// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A device and its clients without sockets and without anybody who waits: the test says when a turn
// is complete.
#include "daemon/device/device.h"

#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "protocol/char_code.h"
#include "protocol/client/decoder.h"
#include "protocol/client/scan_message.h"
#include "protocol/timestamp.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using protocol::client::ScanMessage;

std::string all_messages(Endpoint::Client& client) {
    std::string bytes;
    while (const auto action = client.session().next_action())
        bytes += std::get<protocol::Send>(*action).bytes;
    return bytes;
}

ScanMessage scan_in(std::string_view bytes) {
    protocol::client::Decoder decoder;
    const auto message = decoder.next(bytes);
    EXPECT_TRUE(message);
    auto scan = protocol::client::parse_scan(*message);
    EXPECT_TRUE(std::holds_alternative<ScanMessage>(scan)) << std::get<std::string>(scan);
    return std::get<ScanMessage>(std::move(scan));
}

class DeviceTest : public testing::Test {
  protected:
    /// Turns until this client has a message.
    std::string next_of(Endpoint::Client& client) {
        for (;;) {
            clock_.advance_to(device_.leaves(revolution_));
            device_.turn_complete(revolution_++);
            if (std::string bytes = all_messages(client); !bytes.empty()) return bytes;
        }
    }

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    std::int64_t revolution_ = device_.next_revolution();
};

TEST_F(DeviceTest, AnswersWithoutScanning) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("VV\nBM\n");
    EXPECT_NE(all_messages(*client).find("PROD:UST-10LX"), std::string::npos);
    EXPECT_TRUE(device_.state().laser_on());
    EXPECT_FALSE(device_.wanted());
    device_.turn_complete(revolution_);
    EXPECT_EQ(device_.counts().scans, 0U);
    EXPECT_EQ(device_.latest_scan(), nullptr);
}

TEST_F(DeviceTest, ShowsTheSameScanToEveryone) {
    int told = 0;
    const auto first = device_.connect([&] { ++told; }, protocol::LinkKind::network);
    const auto second = device_.connect([] {}, protocol::LinkKind::network);
    first->receive("MD0000108000000\n");
    second->receive("MD0540054001003\n");
    EXPECT_EQ(all_messages(*first), "MD0000108000000\n00P\n\n");
    EXPECT_EQ(all_messages(*second), "MD0540054001003\n00P\n\n");
    EXPECT_TRUE(device_.wanted());

    const ScanMessage whole = scan_in(next_of(*first));
    EXPECT_GT(told, 0);
    EXPECT_EQ(whole.distances_mm.size(), 1081U);
    EXPECT_EQ(whole.distances_mm[540], 4000U);
    EXPECT_EQ(whole.distances_mm[0], 65533U);
    EXPECT_EQ(device_.counts().scans, 1U);
    EXPECT_EQ(device_.latest_scan()->revolution, revolution_ - 1);
    EXPECT_TRUE(device_.counts().lateness.max());
}

TEST_F(DeviceTest, IsWantedAsLongAsSomeStreamRuns) {
    {
        const auto gone = device_.connect([] {}, protocol::LinkKind::network);
        gone->receive("MD0540054000000\n");
        EXPECT_TRUE(device_.wanted());
        EXPECT_EQ(device_.clients(), 1U);
    }
    EXPECT_FALSE(device_.wanted());
    EXPECT_EQ(device_.clients(), 0U);

    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000001\n");
    EXPECT_TRUE(device_.wanted());
    (void)all_messages(*client);
    EXPECT_EQ(scan_in(next_of(*client)).request.scans, 0);
    EXPECT_FALSE(device_.wanted());
}

TEST_F(DeviceTest, TellsWhoeverWaitsThatItIsWanted) {
    int woken = 0;
    device_.on_wanted([&] { ++woken; });
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("VV\n");
    EXPECT_EQ(woken, 0);
    client->receive("MD0540054000000\n");
    EXPECT_EQ(woken, 1);
}

TEST_F(DeviceTest, LetsScansLeaveOnTheTickAfterTheLastStep) {
    SensorConfig real = ideal_sensor();
    real.timing = Timing::real;
    clock_.advance_to(3s);
    Device device("robot", real, 1, world_, clock_);
    // Step 1080 of 1440 is fired 18.79 ms after step 0, and the firmware takes 4.5 ms.
    EXPECT_EQ(device.leaves(0), 3s + 24ms);
    EXPECT_EQ(device.leaves(1'000'000) - device.leaves(0), 25'050s);
    // Without the firmware's tick.
    EXPECT_EQ(device_.leaves(4) - device_.leaves(0), 100ms);
}

TEST_F(DeviceTest, IsFoundAsItWasPoweredUp) {
    SensorConfig cold = ideal_sensor();
    cold.timing = Timing::real;
    cold.power_up = PowerUp::boot;
    Device booting("robot", cold, 1, world_, clock_);
    const auto early = booting.connect([] {}, protocol::LinkKind::network);
    early->receive("VV\n");
    EXPECT_TRUE(booting.state().booting(booting.uptime()));
    EXPECT_EQ(all_messages(*early), "");
    // UST-10LX: up to ten seconds, in which it takes connections but does not answer.
    ASSERT_TRUE(early->wake_at());
    EXPECT_EQ(*early->wake_at(), 10s);
    clock_.advance_to(*early->wake_at());
    early->wake();
    EXPECT_NE(all_messages(*early).find("PROD:UST-10LX"), std::string::npos);

    SensorConfig old = ideal_sensor("URG-04LX");
    old.power_up = PowerUp::scip1;
    Device ancient("robot", old, 1, world_, clock_);
    const auto client = ancient.connect([] {}, protocol::LinkKind::network);
    client->receive("QT\n");
    EXPECT_EQ(all_messages(*client), "QT\nE\n\n");
    client->receive("SCIP2.0\n");
    EXPECT_EQ(all_messages(*client), "SCIP2.0\n0\n\n");
    client->receive("QT\n");
    EXPECT_EQ(all_messages(*client), "QT\n00P\n\n");
}

TEST_F(DeviceTest, ShowsTheTimeThatItWasSetTo) {
    SensorConfig old = ideal_sensor();
    old.clock.start_ms = 16'777'215;
    Device device("robot", old, 1, world_, clock_);
    const auto client = device.connect([] {}, protocol::LinkKind::network);
    client->receive("TM1\n");
    EXPECT_EQ(all_messages(*client).substr(8, 4), "oooo");
    clock_.advance_to(1ms);
    client->receive("TM1\n");
    EXPECT_EQ(all_messages(*client).substr(8, 4), "0000");
    client->receive("RS\nTM1\n");
    EXPECT_EQ(all_messages(*client), "RS\n00P\n\nTM1\n00P\n00000\n\n");
}

TEST_F(DeviceTest, LivesByItsOwnClock) {
    SensorConfig fast = ideal_sensor();
    fast.timing = Timing::real;
    fast.clock.ppm = 200.0;
    Device device("robot", fast, 1, world_, clock_);
    const auto client = device.connect([] {}, protocol::LinkKind::network);
    clock_.advance_to(1000s);
    client->receive("TM1\n");
    ASSERT_TRUE(client->wake_at());
    clock_.advance_to(*client->wake_at());
    client->wake();
    // 1000.2 s on its clock, and half of what a reply takes.
    std::string stamp;
    protocol::append_encoded(stamp, 1'000'200, protocol::timestamp_width);
    EXPECT_EQ(all_messages(*client).substr(8, 4), stamp);
    // The mirror hangs on the same crystal.
    const std::chrono::duration<double> turns = device.leaves(40'000) - device.leaves(0);
    const std::chrono::duration<double> periods = 40'000 * device.profile().scan_period;
    EXPECT_NEAR(turns / periods, 1.0 / 1.0002, 2e-6);
}

TEST_F(DeviceTest, SweepsFromPosesAtTheTimeOfEachBeam) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0000108000000\n");
    (void)all_messages(*client);
    // 2 m/s towards the wall: the beam ahead is fired 9.375 ms after step 0.
    const sim::Time start = device_.leaves(revolution_) - 1s;
    for (int i = 0; i <= 40; ++i) {
        (void)world_.place_robot(
            "robot", {start + i * 50ms, sim::pose_from_rpy({i * 0.1, 0, 0}, {0, 0, 0})});
    }
    (void)next_of(*client);
    const auto& scan = *device_.latest_scan();
    ASSERT_EQ(scan.world_from_sensor.size(), 1081U);
    const auto seconds = [](sim::Time time) { return std::chrono::duration<double>(time).count(); };
    for (const int step : {0, 540, 1080}) {
        const sim::Time fired = scan.start + step * sim::Time(25ms) / 1440;
        const auto beam = static_cast<std::size_t>(step);
        EXPECT_NEAR(scan.world_from_sensor[beam].translation_m.x, 2.0 * seconds(fired - start),
                    1e-6);
    }
    EXPECT_NEAR(scan.readings[540].range_m, 4.0 - scan.world_from_sensor[540].translation_m.x,
                1e-4);
}

TEST_F(DeviceTest, SharesPosesAmongBeamsWhereFewAreAskedFor) {
    SensorConfig coarse = ideal_sensor();
    coarse.motion = 3;
    Device device("robot", coarse, 1, world_, clock_);
    const auto client = device.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0000108000000\n");
    std::int64_t revolution = device.next_revolution() + 2;
    const sim::Time start = device.leaves(revolution) - 500ms;
    (void)world_.place_robot("robot", {start, sim::Pose{}});
    (void)world_.place_robot("robot", {start + 900ms, sim::pose_from_rpy({1, 0, 0}, {0, 0, 0})});
    device.turn_complete(revolution);
    ASSERT_TRUE(device.latest_scan());
    const auto& poses = device.latest_scan()->world_from_sensor;
    ASSERT_EQ(poses.size(), 1081U);
    int changes = 0;
    for (std::size_t i = 1; i < poses.size(); ++i)
        changes += poses[i] == poses[i - 1] ? 0 : 1;
    EXPECT_EQ(changes, 2);
}

}  // namespace
}  // namespace scipd::daemon
