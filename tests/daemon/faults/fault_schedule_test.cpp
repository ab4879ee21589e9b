// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/fault_schedule.h"

#include <chrono>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using Phase = FaultSchedule::Phase;

constexpr sim::Time period = 25ms;

FaultPlan plan_of(const FaultKind& kind, FaultStart start, FaultEnd end = UntilStopped{},
                  FaultRepetition every = {}) {
    return {.kind = &kind, .start = std::move(start), .end = std::move(end), .every = every};
}

constexpr FaultKind lasting{.name = "lasting", .momentary = false};
constexpr FaultKind momentary{.name = "momentary", .momentary = true};

FaultMoment serving(std::int64_t scan) {
    return {.scan = scan, .serving = true, .time = (scan + 1) * period};
}

/// Goes through the scans, and says with which ones the fault is active.
std::vector<std::int64_t> active_scans(FaultSchedule& schedule, std::int64_t from,
                                       std::int64_t to) {
    std::vector<std::int64_t> active;
    for (std::int64_t scan = from; scan <= to; ++scan) {
        const FaultMoment now = serving(scan);
        if (schedule.over(now)) schedule.end(now);
        if (schedule.due(now)) schedule.begin(now);
        if (schedule.phase() == Phase::active) active.push_back(scan);
        if (schedule.over(now)) schedule.end(now);
    }
    return active;
}

using Scans = std::vector<std::int64_t>;

TEST(FaultSchedule, LastsForSoManyScansFromOneOn) {
    FaultSchedule schedule(plan_of(lasting, AtScan{5}, ForScans{3}), 1, {});
    EXPECT_EQ(schedule.next_scan(), 5);
    EXPECT_EQ(active_scans(schedule, 0, 20), (Scans{5, 6, 7}));
    EXPECT_EQ(schedule.phase(), Phase::ended);
}

TEST(FaultSchedule, BeginsAtOnceWhereItsScanHasPassed) {
    FaultSchedule schedule(plan_of(lasting, AtScan{5}, ForScans{2}), 1, serving(100));
    EXPECT_EQ(active_scans(schedule, 101, 110), (Scans{101, 102}));
}

TEST(FaultSchedule, LastsFromWhenItWasDueWhereThatIsNoticedLate) {
    FaultSchedule scans(plan_of(lasting, AtScan{5}, ForScans{10}), 1, {});
    const FaultMoment late{.scan = 8, .time = 9 * period + 1ms};
    ASSERT_TRUE(scans.due(late));
    scans.begin(late);
    EXPECT_EQ(active_scans(scans, 9, 20), (Scans{9, 10, 11, 12, 13, 14}));
    FaultSchedule time(plan_of(lasting, AfterTime{100ms}, ForTime{200ms}), 1, {});
    time.begin({.time = 130ms});
    EXPECT_EQ(time.next_time({}), 300ms);
}

TEST(FaultSchedule, CountsScansFromWhereItWasAskedFor) {
    FaultSchedule schedule(plan_of(lasting, AfterScans{4}, ForScans{2}), 1, serving(10));
    EXPECT_EQ(active_scans(schedule, 11, 30), (Scans{14, 15}));
}

TEST(FaultSchedule, BetweenTwoScansBeginsWithTheNext) {
    FaultSchedule schedule(plan_of(lasting, AtOnce{}, ForScans{2}), 1, serving(10));
    const FaultMoment between{.scan = 10, .time = 11 * period + 1ms};
    ASSERT_TRUE(schedule.due(between));
    schedule.begin(between);
    EXPECT_EQ(active_scans(schedule, 11, 20), (Scans{11, 12}));
}

TEST(FaultSchedule, LastsForATime) {
    FaultSchedule schedule(plan_of(lasting, AfterTime{100ms}, ForTime{60ms}), 1, {});
    EXPECT_EQ(schedule.next_time({}), 100ms);
    // Scan n is served at 25 (n + 1) ms.
    EXPECT_EQ(active_scans(schedule, 0, 20), (Scans{3, 4, 5}));
}

TEST(FaultSchedule, TakesATimeAsPeopleCallIt) {
    const sim::Time origin = 1000s;
    FaultSchedule schedule(plan_of(lasting, AtTime{1002s}), 1, {});
    EXPECT_FALSE(schedule.due({.time = 1s, .origin = origin}));
    EXPECT_TRUE(schedule.due({.time = 2s, .origin = origin}));
    EXPECT_EQ(schedule.next_time(origin), 2s);
}

TEST(FaultSchedule, LastsUntilItIsStoppedWhereNothingIsSaid) {
    FaultSchedule schedule(plan_of(lasting, AtScan{2}), 1, {});
    EXPECT_EQ(active_scans(schedule, 0, 1000).size(), 999U);
    EXPECT_EQ(schedule.phase(), Phase::active);
}

TEST(FaultSchedule, IsOverAtOnceWhereItsKindIs) {
    FaultSchedule schedule(plan_of(momentary, AtScan{2}), 1, {});
    EXPECT_EQ(active_scans(schedule, 0, 10), (Scans{2}));
    EXPECT_EQ(schedule.phase(), Phase::ended);
}

TEST(FaultSchedule, LetsAMomentaryKindLastForAsLongAsIsSaid) {
    FaultSchedule schedule(plan_of(momentary, AtScan{2}, ForScans{3}), 1, {});
    EXPECT_EQ(active_scans(schedule, 0, 10), (Scans{2, 3, 4}));
}

TEST(FaultSchedule, BeginsWithTheNthRequest) {
    FaultSchedule schedule(plan_of(lasting, AtRequest{"MD", 2}, UntilRequest{"QT"}), 1, {});
    EXPECT_FALSE(schedule.due(serving(1000)));
    EXPECT_FALSE(schedule.begins_with("MD"));
    EXPECT_FALSE(schedule.begins_with("QT"));
    ASSERT_TRUE(schedule.begins_with("MD"));
    schedule.begin(serving(7));
    EXPECT_FALSE(schedule.ends_with("MD"));
    EXPECT_FALSE(schedule.ends_with_boot());
    EXPECT_TRUE(schedule.ends_with("QT"));
    schedule.end(serving(8));
    EXPECT_EQ(schedule.phase(), Phase::ended);
    EXPECT_FALSE(schedule.begins_with("MD"));
}

TEST(FaultSchedule, RepeatsAtEvenDistances) {
    const FaultRepetition every = Every<std::int64_t>{10, 0};
    FaultSchedule schedule(plan_of(momentary, AtOnce{}, UntilStopped{}, every), 1, serving(0));
    EXPECT_EQ(active_scans(schedule, 1, 45), (Scans{10, 20, 30, 40}));
    EXPECT_EQ(schedule.phase(), Phase::waiting);
}

TEST(FaultSchedule, LeavesOutWhatWouldHaveBegunWhileTheOneBeforeLasted) {
    const FaultRepetition every = Every<std::int64_t>{10, 0};
    FaultSchedule schedule(plan_of(lasting, AtOnce{}, ForScans{12}, every), 1, serving(0));
    const Scans active = active_scans(schedule, 1, 55);
    EXPECT_EQ(active.front(), 10);
    EXPECT_EQ(active.size(), 24U + 6U) << "10 to 21, 30 to 41, 50 to 55";
}

TEST(FaultSchedule, JittersWithinItsBoundsAndTheSameForTheSameSeed) {
    const FaultRepetition every = Every<std::int64_t>{100, 20};
    const auto begins = [&](std::uint64_t seed) {
        FaultSchedule schedule(plan_of(momentary, AtOnce{}, UntilStopped{}, every), seed,
                               serving(0));
        return active_scans(schedule, 1, 1050);
    };
    const Scans some = begins(1);
    ASSERT_EQ(some.size(), 10U);
    bool uneven = false;
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto even = static_cast<std::int64_t>(100 * (i + 1));
        EXPECT_LE(std::abs(some[i] - even), 20);
        uneven = uneven || some[i] != even;
    }
    EXPECT_TRUE(uneven);
    EXPECT_EQ(begins(1), some);
    EXPECT_NE(begins(2), some);
}

TEST(FaultSchedule, FindsItsNextRepetitionAlsoAfterAVeryLongTime) {
    const FaultRepetition every = Every<sim::Time>{1ms, 0ms};
    FaultSchedule schedule(plan_of(lasting, AtOnce{}, UntilRequest{"RB"}, every), 1, {});
    schedule.begin({.time = 1ms});
    schedule.end({.time = 1'000'000s});
    EXPECT_EQ(schedule.next_time({}), 1'000'000s + 1ms);
}

}  // namespace
}  // namespace scipd::daemon
