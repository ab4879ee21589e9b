// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans whose angles go down are those of a scanner that hangs upside down. Codes of SCIP come back
// from metres.
#include "sim/recording/values/recorded_scan.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scipd::tests {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::Optional;

TEST(CounterClockwise, TurnsWhatGoesDown) {
    sim::RecordedScan scan{.ranges = {1, 2, 3}, .intensities = {10, 20, 30}};
    scan.directions = {.first_rad = 0.5, .increment_rad = -0.25};
    const sim::RecordedScan turned = counter_clockwise(scan);
    EXPECT_THAT(turned.ranges, ElementsAre(3, 2, 1));
    EXPECT_THAT(turned.intensities, ElementsAre(30, 20, 10));
    EXPECT_THAT(turned.directions.first_rad, Optional(DoubleEq(0.0)));
    EXPECT_THAT(turned.directions.increment_rad, Optional(0.25));
    EXPECT_EQ(counter_clockwise(turned), turned);
}

TEST(CounterClockwise, KeepsTheEchoesOfAStepFromNearToFar) {
    sim::RecordedScan scan{.ranges = {1, 2, 5, 3}, .echo_ends = {1, 3, 3, 4}};
    scan.directions.increment_rad = -0.25;
    const sim::RecordedScan turned = counter_clockwise(scan);
    EXPECT_THAT(turned.ranges, ElementsAre(3, 2, 5, 1));
    EXPECT_THAT(turned.echo_ends, ElementsAre(1, 1, 3, 4));
}

TEST(CounterClockwise, LeavesWhatSaysNothing) {
    const sim::RecordedScan scan{.ranges = {1, 2, 3}};
    EXPECT_EQ(counter_clockwise(scan), scan);
}

using Kind = sim::RecordedReading::Kind;

/// As drivers publish it: a float in metres.
sim::RecordedReading published(float range_m) {
    return sim::reading_of(double{range_m}, sim::RangeUnit::metres,
                           {.min_range_m = 0.02, .max_range_m = 60.0});
}

TEST(ReadingOf, TakesThousandthsOfMetresForCodes) {
    for (const std::uint32_t code : {1, 2, 3, 5, 6, 7, 8, 10, 15, 19, 65533, 65534}) {
        const auto reading = published(static_cast<float>(code) / 1000.0F);
        EXPECT_EQ(reading.kind, Kind::code) << code;
        EXPECT_EQ(reading.code, code);
    }
}

TEST(ReadingOf, KeepsDistancesAndWhatStandsForNone) {
    EXPECT_EQ(published(0.02F).kind, Kind::distance);
    EXPECT_FLOAT_EQ(static_cast<float>(published(1.2345F).range_m), 1.2345F);
    EXPECT_EQ(published(60.0F).kind, Kind::distance);
    EXPECT_EQ(published(60.5F).kind, Kind::too_far);
    EXPECT_EQ(published(0.0065F).kind, Kind::too_near);
    EXPECT_EQ(published(INFINITY).kind, Kind::too_far);
    EXPECT_EQ(published(-INFINITY).kind, Kind::too_near);
    EXPECT_EQ(published(std::nanf("")).kind, Kind::nothing);
    EXPECT_EQ(published(0.0F).kind, Kind::nothing);
    EXPECT_EQ(published(-1.0F).kind, Kind::nothing);
}

TEST(ReadingOf, KnowsTheCodesOfMillimetres) {
    const sim::ScannerIdentity unknown;
    EXPECT_EQ(sim::reading_of(19, sim::RangeUnit::millimetres, unknown).code, 19U);
    EXPECT_EQ(sim::reading_of(0, sim::RangeUnit::millimetres, unknown).kind, Kind::code);
    EXPECT_EQ(sim::reading_of(20, sim::RangeUnit::millimetres, unknown).range_m, 0.02);
    EXPECT_EQ(sim::reading_of(65532, sim::RangeUnit::millimetres, unknown).kind, Kind::distance);
    EXPECT_EQ(sim::reading_of(65533, sim::RangeUnit::millimetres, unknown).code, 65533U);
}

}  // namespace
}  // namespace scipd::tests
