// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scan_timing.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

/// 40 turns a second, 1440 steps a turn, steps 0 to 1080 measured.
SensorSpec spec() {
    return {.steps_per_turn = 1440,
            .first_step = 0,
            .last_step = 1080,
            .front_step = 540,
            .scan_period = 25ms};
}

constexpr Time epoch = 3s + 7ns;

TEST(ScanTiming, StartsEveryPeriod) {
    const ScanTiming timing(spec(), epoch);
    EXPECT_EQ(timing.start(0), epoch);
    EXPECT_EQ(timing.start(1), epoch + 25ms);
    EXPECT_EQ(timing.start(40), epoch + 1s);
    EXPECT_EQ(timing.start(-2), epoch - 50ms);
}

TEST(ScanTiming, FiresStepsEvenly) {
    const ScanTiming timing(spec(), epoch);
    EXPECT_EQ(timing.fired(0, 0), epoch);
    EXPECT_EQ(timing.fired(0, 720), epoch + 12'500us);
    EXPECT_EQ(timing.fired(3, 360), epoch + 75ms + 6'250us);
    EXPECT_EQ(timing.fired(0, 1440), timing.start(1));
    EXPECT_EQ(timing.complete(5), timing.fired(5, 1080));
}

TEST(ScanTiming, RoundsAStepToLessThanANanosecond) {
    const ScanTiming timing(spec(), epoch);
    for (int step = 0; step <= 1440; ++step) {
        const double exact_ns = 25e6 * step / 1440;
        const Time fired = timing.fired(0, step) - epoch;
        EXPECT_NEAR(static_cast<double>(fired.count()), exact_ns, 1.0);
    }
}

TEST(ScanTiming, DoesNotDrift) {
    const ScanTiming timing(spec(), epoch);
    constexpr std::int64_t many = 1'000'000'000;
    EXPECT_EQ(timing.start(many), epoch + 25'000'000s);
    EXPECT_EQ(timing.revolution_at(epoch + 25'000'000s), many);
    EXPECT_EQ(timing.fired(many, 720) - timing.start(many), 12'500us);
}

TEST(ScanTiming, KnowsWhichRevolutionIsUnderWay) {
    const ScanTiming timing(spec(), epoch);
    EXPECT_EQ(timing.revolution_at(epoch), 0);
    EXPECT_EQ(timing.revolution_at(epoch + 25ms - 1ns), 0);
    EXPECT_EQ(timing.revolution_at(epoch + 25ms), 1);
    EXPECT_EQ(timing.revolution_at(epoch - 1ns), -1);
    EXPECT_EQ(timing.revolution_at(epoch - 25ms), -1);
    EXPECT_EQ(timing.revolution_at(epoch - 25ms - 1ns), -2);
}

TEST(ScanTiming, KnowsWhichScanIsTheLatestCompleteOne) {
    const ScanTiming timing(spec(), epoch);
    EXPECT_EQ(timing.latest_complete(epoch), -1);
    EXPECT_EQ(timing.latest_complete(timing.complete(0) - 1ns), -1);
    EXPECT_EQ(timing.latest_complete(timing.complete(0)), 0);
    EXPECT_EQ(timing.latest_complete(timing.complete(1) - 1ns), 0);
    EXPECT_EQ(timing.latest_complete(timing.complete(1)), 1);
}

TEST(ScanTiming, TurnsAtAnotherSpeedFromAPassOfStepZeroOn) {
    ScanTiming timing(spec(), epoch);
    timing.turn_from(epoch + 75ms, 30ms);
    EXPECT_EQ(timing.start(2), epoch + 50ms);
    EXPECT_EQ(timing.fired(2, 720), epoch + 62'500us);
    EXPECT_EQ(timing.start(3), epoch + 75ms);
    EXPECT_EQ(timing.start(4), epoch + 105ms);
    EXPECT_EQ(timing.fired(4, 720), epoch + 120ms);
    EXPECT_EQ(timing.revolution_at(epoch + 75ms - 1ns), 2);
    EXPECT_EQ(timing.revolution_at(epoch + 105ms - 1ns), 3);
    EXPECT_EQ(timing.latest_complete(epoch + 75ms + 22'500us - 1ns), 2);
    EXPECT_EQ(timing.latest_complete(epoch + 75ms + 22'500us), 3);
    EXPECT_EQ(timing.start(1'000'000'003), epoch + 75ms + 30'000'000s);
}

TEST(ScanTiming, TakesTheLastWordOnTheTurnsToCome) {
    ScanTiming timing(spec(), epoch);
    timing.turn_from(epoch + 75ms, 30ms);
    timing.turn_from(epoch + 75ms, 40ms);  // before it got there
    timing.turn_from(epoch + 75ms, 40ms);
    EXPECT_EQ(timing.start(3), epoch + 75ms);
    EXPECT_EQ(timing.start(4), epoch + 115ms);
    EXPECT_EQ(timing.start(2), epoch + 50ms);
    // Power comes anew in the midst of revolution 2, before that.
    timing.turn_from(epoch + 60ms, 25ms);
    EXPECT_EQ(timing.start(2), epoch + 50ms);
    EXPECT_EQ(timing.start(3), epoch + 60ms);
    EXPECT_EQ(timing.start(4), epoch + 85ms);
}

TEST(ScanTiming, AgreesWithItselfHoweverOftenTheSpeedChanges) {
    ScanTiming timing(spec(), epoch);
    Time pass = epoch;
    for (int change = 0; change < 1000; ++change) {
        const Time period = 25ms + change % 11 * 270us;
        timing.turn_from(pass, period);
        const std::int64_t n = timing.revolution_at(pass);
        EXPECT_EQ(timing.start(n), pass);
        EXPECT_EQ(timing.revolution_at(pass - 1ns), n - 1);
        EXPECT_EQ(n, 3 * change);
        pass += 3 * period;
    }
}

TEST(ScanTiming, AgreesWithItselfForEveryRevolution) {
    SensorSpec odd = spec();
    odd.scan_period = Time{99'999'989};  // a prime
    odd.steps_per_turn = 1024;
    odd.last_step = 725;
    const ScanTiming timing(odd, epoch);
    for (std::int64_t n = -100'000; n <= 100'000; n += 997) {
        EXPECT_EQ(timing.revolution_at(timing.start(n)), n);
        EXPECT_EQ(timing.revolution_at(timing.start(n + 1) - 1ns), n);
        EXPECT_EQ(timing.latest_complete(timing.complete(n)), n);
        EXPECT_EQ(timing.latest_complete(timing.complete(n + 1) - 1ns), n);
    }
}

}  // namespace
}  // namespace scipd::sim
