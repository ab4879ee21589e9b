// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Time that a test has go on.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/recording/open_recording.h"
#include "testing/scipd_test.h"
#include "tests/support/scanner_wire.h"
#include "tests/support/temp_dir.h"
#include "tests/testing/room.h"

namespace {

using namespace scipd::testing;
using namespace std::chrono_literals;
using Lockstep = ScipdTest;
using ::scipd::tests::ScannerWire;

TEST_F(Lockstep, GoesOnByWhatWasAskedFor) {
    Scipd& scipd = start({.world = room, .clock = ClockKind::poses, .accuracy = "ideal"});
    EXPECT_EQ(scipd.clock().time_s(), 0);
    scipd.clock().run(20s);
    EXPECT_NEAR(scipd.clock().time_s(), 20, 1e-5);
    std::this_thread::sleep_for(100ms);
    EXPECT_NEAR(scipd.clock().time_s(), 20, 1e-5);
    scipd.robot().set_pose({1, 0, 0});
    EXPECT_NEAR(scipd.robot().pose().x_m, 1, 1e-9);
    EXPECT_EQ(scipd.scan().at(0), 2.0);
    EXPECT_NEAR(scipd.truth().at(0)->range_m, 2.0, 1e-6);
    EXPECT_LT(scipd.clock().time_s(), 21);
}

TEST(LockstepScans, AreConsecutiveRevolutions) {
    for (const char* const model : {"UST-10LX", "URG-04LX", "UXM-30LX-E"}) {
        Scipd scipd({.world = room, .model = model, .clock = ClockKind::poses});
        int number = scipd.truth(scipd.scan()).raw.at("scan");
        for (int i = 0; i < 10; ++i) {
            const int next = scipd.truth(scipd.scan()).raw.at("scan");
            EXPECT_EQ(next, number + 1) << model;
            number = next;
        }
    }
}

TEST_F(Lockstep, WhatChangesBetweenTwoScansHoldsForAllOfTheNext) {
    Scipd& scipd = start({.world = room, .clock = ClockKind::poses, .accuracy = "ideal"});
    constexpr double left = std::numbers::pi / 2;
    (void)scipd.scan();
    for (const auto& [x_m, y_m] :
         std::vector<std::pair<double, double>>{{1, 0}, {-1, -0.5}, {0.5, 1}}) {
        scipd.robot().set_pose({x_m, y_m, 0});
        const Scan scan = scipd.scan();
        EXPECT_NEAR(scan.at(-left).value(), 2 + y_m, 1e-3);
        EXPECT_NEAR(scan.at(0).value(), 3 - x_m, 1e-3);
        EXPECT_NEAR(scan.at(left).value(), 2 - y_m, 1e-3);
    }
}

TEST_F(Lockstep, MovesRobotsAndModels) {
    Scipd& scipd = start({.world = room, .clock = ClockKind::poses, .accuracy = "ideal"});
    scipd.robot().set_pose({-1, 0, 0});
    scipd.scene().move("box", {2, 0, 0});
    EXPECT_NEAR(scipd.truth().at(0)->range_m, 2.7, 1e-6);
    EXPECT_NEAR(scipd.robot().pose().x_m, -1, 1e-9) << "it stays there while others move";
    scipd.scene().remove("box");
    scipd.robot().drive_to({1, 0, 0}, 4s);
    EXPECT_NEAR(scipd.clock().time_s(), 4, 0.5);
    EXPECT_EQ(scipd.scan().at(0), 2.0);
}

TEST_F(Lockstep, PlaysADriveAndRecordsIt) {
    Scipd& scipd = start({.world = room, .clock = ClockKind::poses, .accuracy = "ideal"});
    const ::scipd::tests::TempDir folder;
    std::ofstream(folder.path() / "drive.tum") << "# t tx ty tz qx qy qz qw\n"
                                                  "100 -1 0 0 0 0 0 1\n\n"
                                                  "101 0 0 0 0 0 0 1\n"
                                                  "103 1 0 0 0 0 0 1\n";
    const auto file = folder.path() / "drive.mcap";
    const auto recording = scipd.record(file);
    scipd.robot().play(folder.path() / "drive.tum", 2.0);
    EXPECT_NEAR(scipd.clock().time_s(), 1.5, 0.01);
    EXPECT_NEAR(scipd.robot().pose().x_m, 1, 1e-9);
    recording.stop();
    EXPECT_NEAR(double(recording.scans()), 60, 2);

    auto opened = ::scipd::sim::open_recording(file);
    ASSERT_TRUE(opened) << opened.error().why;
    std::size_t scans = 0;
    for (auto item = (*opened)->next(); item && *item; item = (*opened)->next()) {
        const auto& scan = std::get<::scipd::sim::RecordedScan>((*item)->what);
        // The middle of a turn of 25 ms; 2 m a second, and from half a second on 1 m.
        const double at_s =
            std::chrono::duration<double>(scan.host_time->time_since_epoch()).count();
        const double ahead_s = at_s + 0.375 * 0.025;
        const double x_m = ahead_s < 0.5 ? -1 + 2 * ahead_s : std::min(ahead_s - 0.5, 1.0);
        if (at_s > 0) {
            EXPECT_NEAR(scan.ranges_of(540).front(), 1000 * (3 - x_m), 2) << at_s;
        }
        ++scans;
    }
    EXPECT_EQ(scans, recording.scans());
    EXPECT_TRUE((*opened)->warnings().empty());
}

TEST_F(Lockstep, SaysWhatIsWrongWithADriveOrARecording) {
    Scipd& scipd = start({.world = room, .clock = ClockKind::poses});
    const ::scipd::tests::TempDir folder;
    const auto refusal = [&](const std::string& text) -> std::string {
        std::ofstream(folder.path() / "a.tum") << text;
        try {
            scipd.robot().play(folder.path() / "a.tum");
        } catch (const ScipdError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n2 0 0 0\n"), ::testing::HasSubstr("a.tum:2: is no line"));
    EXPECT_THAT(refusal("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"),
                ::testing::HasSubstr(":2: the times"));
    EXPECT_THAT(refusal("# nothing\n"), ::testing::HasSubstr("holds no pose"));
    EXPECT_THROW((void)scipd.record(folder.path() / "a.txt"), std::invalid_argument);
}

/// What a driver gets in a drive with a fault and a crate.
std::vector<std::uint32_t> bytes_of_a_drive() {
    Scipd scipd({.world = room, .clock = ClockKind::poses, .seed = 5});
    auto driver = ScannerWire::tcp(scipd.port());
    driver.write("MD0000108001000\n");
    scipd.wire().wait_for("MD");
    std::vector<std::uint32_t> got;
    const auto reader = std::async(std::launch::async, [&] {
        EXPECT_EQ(driver.next_message()->status, "00");
        for (int i = 0; i < 100; ++i) {
            const auto scan = driver.next_scan();
            got.push_back(scan.stamp_ms);
            got.insert(got.end(), scan.distances_mm.begin(), scan.distances_mm.end());
        }
    });
    scipd.clock().run(500ms);
    scipd.robot().drive_to({1, 0, 1}, 1s);
    scipd.fault("blind", {{"steps", {500, 580}}, {"after", 0.5}, {"seconds", 1}});
    scipd.scene().add("crate", Box{{0.4, 0.4, 0.4}}, {2, 0.5, 0});
    scipd.clock().run(2s);
    reader.wait();
    return got;
}

TEST(LockstepTwice, GivesTheSameBytes) {
    const auto once = bytes_of_a_drive();
    EXPECT_EQ(once.size(), 100U * 1082);
    EXPECT_TRUE(once == bytes_of_a_drive());
}

TEST_F(Lockstep, IsLedByThePosesOfOthers) {
    // It goes on as long as somebody waits for scans, so fast that a short one may have ended
    // before it is asked for.
    const ::scipd::tests::TempDir folder;
    const auto poses = folder.path() / "long.tum";
    std::ofstream(poses) << "0 0 0 0 0 0 0 1\n100000 1 0 0 0 0 0 1\n";
    Scipd& scipd =
        start({.world = room, .poses = poses, .clock = ClockKind::poses, .accuracy = "ideal"});
    const double before_s = scipd.clock().time_s();
    scipd.clock().run(2s);
    EXPECT_GE(scipd.clock().time_s(), before_s + 2);
    EXPECT_THROW(scipd.robot().set_pose({0, 0, 0}), ScipdError);
}

TEST_F(Lockstep, IsNotWhatTheWallClockIs) {
    Scipd& scipd = start({.world = room});
    const double before_s = scipd.clock().time_s();
    scipd.clock().run(200ms);
    EXPECT_GE(scipd.clock().time_s(), before_s + 0.2);
}

}  // namespace
