// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/replay/replay.h"

#include <chrono>
#include <memory>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Three scans, the second of which took twice as long.
SharedTape three_scans() {
    auto tape = std::make_shared<Tape>(1, false);
    tape->add({{100}, {0}, {}}, 1000, 0ms);
    tape->add({{101}, {0}, {}}, 1025, 25ms);
    tape->add({{102}, {0}, {}}, 1075, 75ms);
    tape->end(25ms);
    return tape;
}

std::size_t scan_at(const Replay& replay, std::int64_t turn) {
    return replay.at({turn}).value().scan;
}

TEST(Replay, ShowsScanAfterScanAndThenNone) {
    const Replay replay(three_scans(), {});
    EXPECT_EQ(scan_at(replay, 0), 0U);
    EXPECT_EQ(replay.at({2})->stamp_ms, 1075U);
    EXPECT_FALSE(replay.at({3}));
    EXPECT_EQ(replay.lasts({1}), 50ms);
    EXPECT_EQ(replay.status({3}).state, "over");
    EXPECT_EQ(replay.status({2}).state, "playing");
    EXPECT_EQ(replay.status({2}).at, 75ms);
    EXPECT_EQ(replay.status({2}).duration, 100ms);
}

TEST(Replay, HasTheRecordedStampsAgainInEachRound) {
    const Replay replay(three_scans(), {.loop = ReplayLoop::again});
    EXPECT_EQ(scan_at(replay, 3), 0U);
    EXPECT_EQ(replay.at({3})->stamp_ms, 1000U);
    EXPECT_EQ(scan_at(replay, 302), 2U);
}

TEST(Replay, LetsStampsGoOnFromRoundToRound) {
    const Replay replay(three_scans(), {.loop = ReplayLoop::on});
    EXPECT_EQ(replay.at({3})->stamp_ms, 1100U);
    EXPECT_EQ(replay.at({7})->stamp_ms, 1225U);
    EXPECT_EQ(replay.at({3 * 200'000})->stamp_ms, (1000U + 20'000'000U) & 0xFFFFFFU);
}

TEST(Replay, BeginsWhereItIsToldAndGoesFaster) {
    const Replay replay(three_scans(), {.speed = 2.0, .from = 30ms});
    EXPECT_EQ(scan_at(replay, 0), 1U);
    EXPECT_EQ(replay.lasts({0}), 25ms);
}

TEST(Replay, RestsWhileItIsPaused) {
    Replay replay(three_scans(), {.loop = ReplayLoop::again});
    replay.steer({.paused = true}, {1});
    EXPECT_EQ(scan_at(replay, 0), 0U);
    EXPECT_FALSE(replay.at({1}));
    EXPECT_FALSE(replay.at({500}));
    EXPECT_EQ(replay.status({500}).state, "paused");
    replay.steer({.paused = false}, {500});
    EXPECT_EQ(scan_at(replay, 500), 1U);
    EXPECT_EQ(scan_at(replay, 501), 2U);
}

TEST(Replay, GoesOnByStepsAndSeeks) {
    Replay replay(three_scans(), {.loop = ReplayLoop::again});
    replay.steer({.step = 2}, {10});
    EXPECT_EQ(scan_at(replay, 10), 1U);
    EXPECT_EQ(scan_at(replay, 11), 2U);
    EXPECT_FALSE(replay.at({12}));
    replay.steer({.step = 1}, {40});
    EXPECT_EQ(scan_at(replay, 40), 0U);
    replay.steer({.at = 80ms, .paused = false}, {50});
    EXPECT_EQ(scan_at(replay, 50), 2U);
}

TEST(Replay, AnswersAStepWithTheStatusBehindIt) {
    Replay replay(three_scans(), {});
    const ReplayStatus stepped = replay.steer({.step = 2}, {0});
    EXPECT_EQ(stepped.state, "paused");
    EXPECT_EQ(stepped.scan, 2U);
    EXPECT_EQ(replay.status({0}).state, "playing") << "until its scans have been shown";
    EXPECT_EQ(replay.status({2}).scan, stepped.scan);
    EXPECT_EQ(replay.steer({.step = 5}, {2}).state, "over");
    const ReplayStatus sought = replay.steer({.at = 0ms, .paused = false}, {20});
    EXPECT_EQ(sought.state, "playing");
    EXPECT_EQ(sought.scan, 0U);
}

ReplayTurn turn_at(sim::Time begins) {
    return {0, begins};
}

TEST(Replay, FollowsTheLineOfStamps) {
    const Replay replay(three_scans(), {.begins = 1000s});
    EXPECT_FALSE(replay.at(turn_at(0s)));
    EXPECT_EQ(replay.lasts(turn_at(0s)), 25ms);
    EXPECT_FALSE(replay.at(turn_at(999'960ms)));
    EXPECT_EQ(replay.lasts(turn_at(999'960ms)), 40ms);  // so that the next one begins in time
    EXPECT_EQ(replay.at(turn_at(1000s))->scan, 0U);
    EXPECT_EQ(replay.lasts(turn_at(1000s)), 25ms);
    EXPECT_EQ(replay.at(turn_at(1000'025ms))->stamp_ms, 1025U);
    EXPECT_FALSE(replay.at(turn_at(1000'050ms)));  // the second scan took twice as long
    EXPECT_EQ(replay.lasts(turn_at(1000'050ms)), 25ms);
    EXPECT_EQ(replay.at(turn_at(1000'075'400us))->scan, 2U);
    EXPECT_FALSE(replay.at(turn_at(1000'100ms)));
    EXPECT_EQ(replay.status(turn_at(1000'100ms)).state, "over");
    EXPECT_EQ(replay.lasts(turn_at(2000s)), 25ms);
}

TEST(Replay, FollowsTheLineOfStampsInEachRoundAndAsFastAsItIsTold) {
    const Replay replay(three_scans(), {.loop = ReplayLoop::on, .speed = 2.0, .begins = 1000s});
    EXPECT_FALSE(replay.at(turn_at(999s)));
    EXPECT_EQ(replay.at(turn_at(1000'037'500us))->scan, 2U);
    EXPECT_EQ(replay.lasts(turn_at(1000'037'500us)), 12'500us);
    EXPECT_EQ(replay.at(turn_at(1000'050ms))->scan, 0U);
    EXPECT_EQ(replay.at(turn_at(1000'050ms))->stamp_ms, 1100U);
}

TEST(Replay, BeginsWhenItWasRecorded) {
    auto tape = std::make_shared<Tape>(1, false);
    tape->set_recorded(1'700'000'000s);
    tape->add({{100}, {0}, {}}, 1000, 0ms);
    tape->end(25ms);
    const Replay replay(tape, {.begins = AsRecorded{}});
    EXPECT_FALSE(replay.at(turn_at(0s)));
    EXPECT_EQ(replay.at(turn_at(1'700'000'000s))->scan, 0U);
}

TEST(Replay, LeavesTheLineOfStampsWhenItIsSteered) {
    Replay replay(three_scans(), {.begins = 1000s});
    replay.steer({.at = 75ms}, {40, 1000'030ms});
    EXPECT_EQ(replay.at({40, 1000'030ms})->scan, 2U);
    EXPECT_FALSE(replay.at({41, 1000'055ms}));
}

}  // namespace
}  // namespace scipd::daemon
