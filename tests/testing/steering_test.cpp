// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a test does with its scipd, against what geometry says.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/scipd_test.h"
#include "tests/support/scanner_wire.h"
#include "tests/testing/room.h"

namespace {

using namespace scipd::testing;
using namespace std::chrono_literals;
using std::numbers::pi;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Steering : public ScipdTest {
  protected:
    Scipd& scipd = start({.world = room, .accuracy = "ideal"});
};

TEST_F(Steering, AScanIsWhatTheRoomIs) {
    scipd.scene().remove("box");
    const Scan scan = scipd.scan();
    ASSERT_EQ(scan.ranges_m.size(), 1081U);
    EXPECT_EQ(scan.intensities.size(), 1081U);
    EXPECT_NEAR(scan.angles_rad.front(), -0.75 * pi, 1e-9);
    // To the right there are only the walls at x = 3 and -3, and at y = -2.
    for (std::size_t i = 0; scan.angles_rad[i] <= 0; ++i) {
        const double angle = scan.angles_rad[i];
        const double wall_m =
            std::min(3 / std::abs(std::cos(angle)), 2 / std::abs(std::sin(angle)));
        ASSERT_NEAR(scan.ranges_m[i].value(), wall_m, 0.0015) << "at " << angle;
    }
    EXPECT_NEAR(scan.at(pi / 4).value(), 1.5 * std::numbers::sqrt2 - 0.25, 0.0015);
    EXPECT_THROW((void)scan.at(pi), std::out_of_range);
    EXPECT_EQ(scan.nearest()->range_m, std::ranges::min(scan.ranges_m).value());
}

TEST_F(Steering, ARobotIsAtOnceWhereItIsPut) {
    scipd.robot().set_pose({1, 0.5, pi / 2});
    EXPECT_EQ(scipd.scan().at(0), 1.5);
    scipd.robot().set_pose({-1, 0.25, 0.01, 0.1, -0.2, 0.3});
    const Pose pose = scipd.robot().pose();
    EXPECT_NEAR(pose.x_m, -1, 1e-9);
    EXPECT_NEAR(pose.y_m, 0.25, 1e-9);
    EXPECT_NEAR(pose.z_m, 0.01, 1e-9);
    EXPECT_NEAR(pose.roll_rad, 0.1, 1e-9);
    EXPECT_NEAR(pose.pitch_rad, -0.2, 1e-9);
    EXPECT_NEAR(pose.yaw_rad, 0.3, 1e-9);
    scipd.robot().drive_to({1, 0, 0}, 300ms);
    EXPECT_EQ(scipd.scan().at(0), 2.0);
}

TEST_F(Steering, TheWorldChanges) {
    EXPECT_THAT(scipd.scene().add("crate", Box{{0.4, 0.6, 0.5}, "wood"}, {2, 0, 0}), IsEmpty());
    const Truth truth = scipd.truth();
    EXPECT_NEAR(truth.at(0)->range_m, 1.8, 1e-6);
    EXPECT_EQ(truth.at(0)->object, "crate::body::box");
    EXPECT_EQ(truth.at(0)->material, "wood");
    scipd.scene().move("crate", {1.5, 0, pi / 2});
    EXPECT_EQ(scipd.scan().at(0), 1.2);
    EXPECT_NEAR(scipd.scene().pose("crate").yaw_rad, pi / 2, 1e-9);
    scipd.scene().remove("crate");
    EXPECT_EQ(scipd.scan().at(0), 3.0);
    EXPECT_THAT(scipd.scene().models(), Not(Contains("crate")));
    scipd.scene().load(SCENES "/corridor.sdf");
    EXPECT_THAT(scipd.scene().models(), Not(Contains("room")));
}

TEST_F(Steering, WhatIsRefusedIsSaid) {
    EXPECT_THROW(scipd.scene().add("flat", Box{{1, 1, 0}}), std::invalid_argument);
    try {
        scipd.scene().remove("ghost");
        ADD_FAILURE() << "a ghost was removed";
    } catch (const Refused& refused) {
        EXPECT_EQ(refused.status(), 404);
        EXPECT_THAT(refused.what(), HasSubstr("ghost"));
    }
    EXPECT_THROW(scipd.fault("stall", {{"after", 1}, {"at", {{"s", 1}}}}), std::invalid_argument);
}

TEST_F(Steering, TheTruthIsThatOfTheScan) {
    const Scan scan = scipd.scan();
    const Truth truth = scipd.truth(scan);
    EXPECT_EQ(truth.raw.at("sent_mm").get<std::vector<std::uint32_t>>(), scan.sent_mm);
    EXPECT_EQ(truth.at(0)->object, "room::body::front");
    EXPECT_NEAR(truth.nearest()->range_m, scan.nearest()->range_m, 0.0015);
}

TEST_F(Steering, AFaultBeginsAndEnds) {
    const Fault fault = scipd.fault("blind", {{"steps", {500, 580}}});
    EXPECT_EQ(fault.state(), "active");
    EXPECT_EQ(scipd.scan().at(0), std::nullopt);
    EXPECT_GT(fault.hits(), 0);
    fault.stop();
    EXPECT_EQ(scipd.scan().at(0), 3.0);
    EXPECT_EQ(scipd.fault("stall", {{"after", 600}, {"seconds", 2}}).state(), "waiting");
    const Fault silence = scipd.fault("stall", {{"seconds", 4}});
    try {
        (void)scipd.scan({}, 1s);  // not each of the driver's tries
        ADD_FAILURE() << "a scanner that stalls has sent a scan";
    } catch (const NoScan& error) {
        EXPECT_THAT(error.what(), HasSubstr("on purpose it has: stall"));
    }
    silence.stop();
}

TEST_F(Steering, BesideADriverAScanComesByTheTtyAndTheWireHasBoth) {
    auto driver = ::scipd::tests::ScannerWire::tcp(scipd.port());
    driver.write("MD0000108001000\n");
    EXPECT_TRUE(scipd.wire().wait_for("MD").from_client);
    EXPECT_EQ(scipd.scan().at(0), 3.0);
    EXPECT_EQ(scipd.wire().wait_for("ME").client, "tty");
    EXPECT_EQ(scipd.wire().wait_for("MD").client, "tcp");
    EXPECT_THAT(scipd.wire().text(), HasSubstr("robot/scanner tcp > MD0000108001000: "));
    EXPECT_THROW(scipd.wire().wait_for("RS", 50ms), ScipdError);
}

}  // namespace
