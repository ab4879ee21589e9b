// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans whose angles go down are those of a scanner that hangs upside down.
#include "sim/recording/values/recorded_scan.h"

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

}  // namespace
}  // namespace scipd::tests
