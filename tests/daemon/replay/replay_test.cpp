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

Replay replay_of(const SharedTape& tape, const ReplayConfig& config = {}) {
    return {track_of(tape), config};
}

/// Its first client comes at 0 s.
Replay begun(const ReplayConfig& config = {}) {
    Replay replay = replay_of(three_scans(), config);
    replay.begin(0s);
    return replay;
}

ReplayTurn turn(sim::Time begins) {
    return {.begins = begins, .stamp = 1000s + begins};
}

std::size_t scan_at(const Replay& replay, sim::Time begins) {
    return replay.at(turn(begins)).value().scan;
}

TEST(Replay, ShowsScanAfterScanAndThenNone) {
    const Replay replay = begun();
    EXPECT_EQ(scan_at(replay, 0ms), 0U);
    EXPECT_EQ(replay.at(turn(75ms))->stamp_ms, 1075U);
    EXPECT_FALSE(replay.at(turn(100ms)));
    EXPECT_EQ(replay.lasts(turn(25ms)), 50ms);
    EXPECT_EQ(replay.status(turn(100ms)).state, "over");
    EXPECT_EQ(replay.status(turn(75ms)).state, "playing");
    EXPECT_EQ(replay.status(turn(75ms)).at, 75ms);
    EXPECT_EQ(replay.status(turn(75ms)).duration, 100ms);
}

TEST(Replay, WaitsForItsFirstClient) {
    Replay replay = replay_of(three_scans());
    EXPECT_FALSE(replay.at(turn(0s)));
    EXPECT_EQ(replay.status(turn(10s)).state, "waiting");
    EXPECT_EQ(replay.status(turn(10s)).scan, 0U);
    EXPECT_EQ(replay.lasts(turn(10s)), 25ms);
    replay.begin(10s);
    replay.begin(20s);
    EXPECT_EQ(scan_at(replay, 10s), 0U);
    EXPECT_EQ(scan_at(replay, 10s + 25ms), 1U);
}

TEST(Replay, CanBeSteeredBeforeItsFirstClient) {
    Replay replay = replay_of(three_scans());
    EXPECT_EQ(replay.steer({.at = 30ms}, turn(5s)).state, "waiting");
    replay.begin(10s);
    EXPECT_EQ(scan_at(replay, 10s), 1U);
    Replay played = replay_of(three_scans());
    EXPECT_EQ(played.steer({.paused = false}, turn(5s)).state, "playing");
    EXPECT_EQ(scan_at(played, 5s), 0U);
}

TEST(Replay, HasTheRecordedStampsAgainInEachRound) {
    const Replay replay = begun({.loop = ReplayLoop::again});
    EXPECT_EQ(scan_at(replay, 100ms), 0U);
    EXPECT_EQ(replay.at(turn(100ms))->stamp_ms, 1000U);
    EXPECT_EQ(scan_at(replay, 10'075ms), 2U);
}

TEST(Replay, LetsStampsGoOnFromRoundToRound) {
    const Replay replay = begun({.loop = ReplayLoop::on});
    EXPECT_EQ(replay.at(turn(100ms))->stamp_ms, 1100U);
    EXPECT_EQ(replay.at(turn(225ms))->stamp_ms, 1225U);
    EXPECT_EQ(replay.at(turn(20'000s))->stamp_ms, (1000U + 20'000'000U) & 0xFFFFFFU);
}

TEST(Replay, BeginsWhereItIsToldAndGoesFaster) {
    const Replay replay = begun({.speed = 2.0, .from = 25ms});
    EXPECT_EQ(scan_at(replay, 0ms), 1U);
    EXPECT_EQ(replay.lasts(turn(0ms)), 25ms);
}

TEST(Replay, RestsWhileItIsPaused) {
    Replay replay = begun({.loop = ReplayLoop::again});
    replay.steer({.paused = true}, turn(25ms));
    EXPECT_FALSE(replay.at(turn(25ms)));
    EXPECT_FALSE(replay.at(turn(10s)));
    EXPECT_EQ(replay.status(turn(10s)).state, "paused");
    replay.steer({.paused = false}, turn(10s));
    EXPECT_EQ(scan_at(replay, 10s), 1U);
    EXPECT_EQ(scan_at(replay, 10s + 50ms), 2U);
}

TEST(Replay, GoesOnByStepsAndSeeks) {
    Replay replay = begun({.loop = ReplayLoop::again});
    replay.steer({.step = 2}, turn(325ms));
    EXPECT_EQ(scan_at(replay, 325ms), 1U);
    EXPECT_EQ(scan_at(replay, 375ms), 2U);
    EXPECT_FALSE(replay.at(turn(400ms)));
    replay.steer({.step = 1}, turn(1s));
    EXPECT_EQ(scan_at(replay, 1s), 0U);
    replay.steer({.at = 80ms, .paused = false}, turn(2s));
    EXPECT_EQ(scan_at(replay, 2s), 2U);
}

TEST(Replay, AnswersAStepWithTheStatusBehindIt) {
    Replay replay = begun();
    const ReplayStatus stepped = replay.steer({.step = 2}, turn(0ms));
    EXPECT_EQ(stepped.state, "paused");
    EXPECT_EQ(stepped.scan, 2U);
    EXPECT_EQ(replay.status(turn(0ms)).state, "playing") << "until its scans have been shown";
    EXPECT_EQ(replay.status(turn(75ms)).scan, stepped.scan);
    EXPECT_EQ(replay.steer({.step = 5}, turn(75ms)).state, "over");
    const ReplayStatus sought = replay.steer({.at = 0ms, .paused = false}, turn(2s));
    EXPECT_EQ(sought.state, "playing");
    EXPECT_EQ(sought.scan, 0U);
}

TEST(Replay, FollowsTheLineOfStamps) {
    const Replay replay = replay_of(three_scans(), {.begins_s = 1000s});
    EXPECT_FALSE(replay.at(turn(-1000s)));
    EXPECT_EQ(replay.lasts(turn(-1000s)), 25ms);
    EXPECT_FALSE(replay.at(turn(-40ms)));
    EXPECT_EQ(replay.lasts(turn(-40ms)), 40ms);  // so that the next one begins in time
    EXPECT_EQ(replay.at(turn(0s))->scan, 0U);
    EXPECT_EQ(replay.lasts(turn(0s)), 25ms);
    EXPECT_EQ(replay.at(turn(25ms))->stamp_ms, 1025U);
    EXPECT_FALSE(replay.at(turn(50ms)));  // the second scan took twice as long
    EXPECT_EQ(replay.lasts(turn(50ms)), 25ms);
    EXPECT_EQ(replay.at(turn(75'400us))->scan, 2U);
    EXPECT_FALSE(replay.at(turn(102ms)));
    EXPECT_EQ(replay.status(turn(102ms)).state, "over");
    EXPECT_EQ(replay.lasts(turn(1000s)), 25ms);
}

TEST(Replay, FollowsTheLineOfStampsInEachRoundAndAsFastAsItIsTold) {
    const Replay replay =
        replay_of(three_scans(), {.loop = ReplayLoop::on, .speed = 2.0, .begins_s = 1000s});
    EXPECT_FALSE(replay.at(turn(-1s)));
    EXPECT_EQ(replay.at(turn(37'500us))->scan, 2U);
    EXPECT_EQ(replay.lasts(turn(37'500us)), 12'500us);
    EXPECT_EQ(replay.at(turn(50ms))->scan, 0U);
    EXPECT_EQ(replay.at(turn(50ms))->stamp_ms, 1100U);
}

TEST(Replay, BeginsWhenItWasRecorded) {
    auto tape = std::make_shared<Tape>(1, false);
    tape->set_recorded(1'700'000'000s);
    tape->add({{100}, {0}, {}}, 1000, 0ms);
    tape->end(25ms);
    const Replay replay = replay_of(tape, {.begins_s = AsRecorded{}});
    EXPECT_FALSE(replay.at(turn(-1000s)));
    EXPECT_EQ(replay.at(turn(1'699'999'000s))->scan, 0U);
}

TEST(Replay, LeavesTheLineOfStampsWhenItIsSteered) {
    Replay replay = replay_of(three_scans(), {.begins_s = 1000s});
    replay.steer({.at = 75ms}, turn(30ms));
    EXPECT_EQ(replay.at(turn(30ms))->scan, 2U);
    EXPECT_FALSE(replay.at(turn(55ms)));
}

// The rear scanner was switched on 3.512 s later, and the log goes on for a second after both.
TEST(Replay, KeepsTheDistanceOfTheScannersOfALog) {
    const auto line = std::make_shared<LogLine>(std::nullopt, 4612ms);
    const ReplayConfig config{.loop = ReplayLoop::again};
    Replay front({.tape = three_scans(), .line = line}, config);
    const Replay rear({.tape = three_scans(), .lead = 3512ms, .line = line}, config);
    front.begin(20s);
    EXPECT_EQ(scan_at(front, 20s), 0U);
    EXPECT_FALSE(rear.at(turn(20s)));
    EXPECT_EQ(rear.status(turn(20s)).state, "playing");
    EXPECT_EQ(rear.lasts(turn(20s + 3470ms)), 42ms);
    EXPECT_EQ(scan_at(rear, 20s + 3512ms), 0U);
    EXPECT_EQ(scan_at(rear, 20s + 3587ms), 2U);
    EXPECT_FALSE(front.at(turn(20s + 3512ms)));
    EXPECT_EQ(scan_at(front, 20s + 4612ms), 0U);
    EXPECT_EQ(scan_at(rear, 20s + 4612ms + 3537ms), 1U);
}

}  // namespace
}  // namespace scipd::daemon
