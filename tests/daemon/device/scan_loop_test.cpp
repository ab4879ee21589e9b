// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/scan_loop.h"

#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/clock/wall_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

class ScanLoopTest : public testing::Test {
  protected:
    boost::asio::io_context io_;
    WallClock clock_{io_.get_executor()};
    World world_ = wall_world();
    Device device_{"robot", ideal_sensor(), 1, world_, clock_};
    std::optional<ScanLoop> loop_{std::in_place, device_, clock_};
};

TEST_F(ScanLoopTest, WaitsForNothingWhereNobodyWantsScans) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("VV\n");
    EXPECT_EQ(io_.run_for(100ms), 0U);
}

TEST_F(ScanLoopTest, ServesEveryTurnOnceAndNoneTooEarly) {
    std::vector<std::int64_t> revolutions;
    const auto client = device_.connect(
        [&] {
            if (device_.counts().scans == revolutions.size()) return;  // a turn that nobody took
            EXPECT_GE(clock_.now(), device_.leaves(device_.latest_scan()->revolution));
            revolutions.push_back(device_.latest_scan()->revolution);
        },
        protocol::LinkKind::network);
    client->receive("MD0540054000008\n");
    ASSERT_TRUE(run_until(io_, [&] { return !device_.wanted(); }));
    // Nobody wants more: there is nothing to wait for.
    EXPECT_EQ(device_.counts().scans, 8U);
    ASSERT_EQ(revolutions.size(), 8U);
    for (std::size_t i = 1; i < revolutions.size(); ++i)
        EXPECT_EQ(revolutions[i], revolutions[i - 1] + 1);
    EXPECT_EQ(loop_->missed(), 0U);
    io_.restart();
    EXPECT_EQ(io_.run_for(100ms), 0U);
}

TEST_F(ScanLoopTest, ServesTurnsThatAreALittleLate) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    ASSERT_TRUE(run_until(io_, [&] { return device_.counts().scans >= 1; }));
    const std::int64_t first = device_.latest_scan()->revolution;
    const auto sent = static_cast<std::int64_t>(device_.counts().scans);
    std::this_thread::sleep_for(300ms);
    ASSERT_TRUE(run_until(io_, [&] { return device_.latest_scan()->revolution > first + 12; }));
    EXPECT_EQ(static_cast<std::int64_t>(device_.counts().scans) - sent,
              device_.latest_scan()->revolution - first);
    EXPECT_EQ(loop_->missed(), 0U);
}

TEST_F(ScanLoopTest, CountsTurnsThatItSleptThrough) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    ASSERT_TRUE(run_until(io_, [&] { return device_.counts().scans >= 1; }));
    const std::int64_t first = device_.latest_scan()->revolution;
    const auto sent = static_cast<std::int64_t>(device_.counts().scans);
    std::this_thread::sleep_for(1300ms);
    ASSERT_TRUE(run_until(io_, [&] { return device_.latest_scan()->revolution > first + 50; }));
    EXPECT_GT(loop_->missed(), 35U);
    // What was not served was missed.
    EXPECT_EQ(static_cast<std::int64_t>(device_.counts().scans) - sent +
                  static_cast<std::int64_t>(loop_->missed()),
              device_.latest_scan()->revolution - first);
}

TEST_F(ScanLoopTest, CountsForThoseWhoWaited) {
    const auto sleep_through = [&] {
        std::int64_t latest = device_.next_revolution();
        ASSERT_TRUE(run_until(io_, [&] {
            return device_.latest_scan() && device_.latest_scan()->revolution > latest;
        }));
        latest = device_.latest_scan()->revolution;
        std::this_thread::sleep_for(1300ms);
        ASSERT_TRUE(
            run_until(io_, [&] { return device_.latest_scan()->revolution > latest + 50; }));
    };
    device_.watch([](const ScanRecord&) {});
    sleep_through();
    EXPECT_EQ(loop_->missed(), 0U);
    const std::uint64_t unwatched = loop_->missed_by_watchers();
    EXPECT_GT(unwatched, 35U);

    device_.watch(nullptr);
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    sleep_through();
    EXPECT_GT(loop_->missed(), 35U);
    EXPECT_EQ(loop_->missed_by_watchers(), unwatched);
}

TEST_F(ScanLoopTest, IsOverdueOnlyWhereScansAreWantedAndNoTurnEnds) {
    std::this_thread::sleep_for(60ms);
    EXPECT_FALSE(loop_->overdue());  // its laser is off
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    EXPECT_FALSE(loop_->overdue());
    std::this_thread::sleep_for(60ms);
    EXPECT_TRUE(loop_->overdue());
    const std::int64_t turn = loop_->turn();
    EXPECT_TRUE(run_until(io_, [&] { return !loop_->overdue(); }));
    EXPECT_GT(loop_->turn(), turn);
}

TEST_F(ScanLoopTest, IsNotOverdueWhereTimeStandsStill) {
    SteppedClock clock;
    World world = wall_world();
    Device device("robot", ideal_sensor(), 1, world, clock);
    ScanLoop loop(device, clock);
    const auto client = device.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    for (int turn = 0; turn < 10; ++turn) {
        EXPECT_FALSE(loop.overdue());
        clock.advance_to(clock.now() + 25ms);
    }
    EXPECT_GT(device.counts().scans, 5U);
    EXPECT_FALSE(loop.overdue());
}

TEST_F(ScanLoopTest, ServesNobodyOnceItIsGone) {
    const auto client = device_.connect([] {}, protocol::LinkKind::network);
    client->receive("MD0540054000000\n");
    loop_.reset();
    io_.run_for(100ms);
    EXPECT_EQ(device_.counts().scans, 0U);
    client->receive("MD0540054000000\n");
    io_.restart();
    EXPECT_EQ(io_.run_for(100ms), 0U);
}

class LatePoses : public testing::Test {
  protected:
    static SensorConfig patient() {
        SensorConfig config = ideal_sensor();
        config.wait_for_poses = 30ms;
        return config;
    }

    void place(sim::Time time) {
        (void)world_.place_robot("robot", {time, sim::Pose{}});
        loop_.poses_came();
    }

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", patient(), 1, world_, clock_};
    ScanLoop loop_{device_, clock_};
    std::unique_ptr<Endpoint::Client> client_ = device_.connect([] {}, protocol::LinkKind::network);
};

TEST_F(LatePoses, AreWaitedForUpToABound) {
    place(0ms);
    client_->receive("MD0540054000000\n");
    // The first turn fires its last step after 18.75 ms.
    place(19ms);
    clock_.advance_to(20ms);
    const std::uint64_t before = device_.counts().scans;
    EXPECT_EQ(before, 1U);
    const sim::Time due = device_.leaves(device_.next_revolution());
    clock_.advance_to(due + 10ms);
    EXPECT_EQ(device_.counts().scans, before);
    place(due);
    clock_.advance_to(due + 10ms);
    EXPECT_EQ(device_.counts().scans, before + 1);

    // The next one gets no pose in time.
    clock_.advance_to(due + 25ms + 29ms);
    EXPECT_EQ(device_.counts().scans, before + 1);
    clock_.advance_to(due + 25ms + 30ms);
    EXPECT_EQ(device_.counts().scans, before + 2);
    EXPECT_EQ(loop_.missed(), 0U);
}

TEST_F(LatePoses, AreNotExpectedOfAStreamThatHasEnded) {
    place(0ms);
    clock_.advance_to(2s);
    client_->receive("MD0540054000000\n");
    const sim::Time due = device_.leaves(device_.next_revolution() + 1);
    clock_.advance_to(due);
    EXPECT_GE(device_.counts().scans, 1U);
}

}  // namespace
}  // namespace scipd::daemon
