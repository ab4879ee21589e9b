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
    return replay.at(turn).value().scan;
}

TEST(Replay, ShowsScanAfterScanAndThenNone) {
    const Replay replay(three_scans(), {});
    EXPECT_EQ(scan_at(replay, 0), 0U);
    EXPECT_EQ(replay.at(2)->stamp_ms, 1075U);
    EXPECT_FALSE(replay.at(3));
    EXPECT_EQ(replay.lasts(1), 50ms);
    EXPECT_EQ(replay.status(3).state, "over");
    EXPECT_EQ(replay.status(2).state, "playing");
    EXPECT_EQ(replay.status(2).at, 75ms);
    EXPECT_EQ(replay.status(2).duration, 100ms);
}

TEST(Replay, HasTheRecordedStampsAgainInEachRound) {
    const Replay replay(three_scans(), {.loop = ReplayLoop::again});
    EXPECT_EQ(scan_at(replay, 3), 0U);
    EXPECT_EQ(replay.at(3)->stamp_ms, 1000U);
    EXPECT_EQ(scan_at(replay, 302), 2U);
}

TEST(Replay, LetsStampsGoOnFromRoundToRound) {
    const Replay replay(three_scans(), {.loop = ReplayLoop::on});
    EXPECT_EQ(replay.at(3)->stamp_ms, 1100U);
    EXPECT_EQ(replay.at(7)->stamp_ms, 1225U);
    EXPECT_EQ(replay.at(3 * 200'000)->stamp_ms, (1000U + 20'000'000U) & 0xFFFFFFU);
}

TEST(Replay, BeginsWhereItIsToldAndGoesFaster) {
    const Replay replay(three_scans(), {.speed = 2.0, .from = 30ms});
    EXPECT_EQ(scan_at(replay, 0), 1U);
    EXPECT_EQ(replay.lasts(0), 25ms);
}

TEST(Replay, RestsWhileItIsPaused) {
    Replay replay(three_scans(), {.loop = ReplayLoop::again});
    replay.steer({.paused = true}, 1);
    EXPECT_EQ(scan_at(replay, 0), 0U);
    EXPECT_FALSE(replay.at(1));
    EXPECT_FALSE(replay.at(500));
    EXPECT_EQ(replay.status(500).state, "paused");
    replay.steer({.paused = false}, 500);
    EXPECT_EQ(scan_at(replay, 500), 1U);
    EXPECT_EQ(scan_at(replay, 501), 2U);
}

TEST(Replay, GoesOnByStepsAndSeeks) {
    Replay replay(three_scans(), {.loop = ReplayLoop::again});
    replay.steer({.step = 2}, 10);
    EXPECT_EQ(scan_at(replay, 10), 1U);
    EXPECT_EQ(scan_at(replay, 11), 2U);
    EXPECT_FALSE(replay.at(12));
    replay.steer({.step = 1}, 40);
    EXPECT_EQ(scan_at(replay, 40), 0U);
    replay.steer({.at = 80ms, .paused = false}, 50);
    EXPECT_EQ(scan_at(replay, 50), 2U);
}

}  // namespace
}  // namespace scipd::daemon
