// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/lateness.h"

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

TEST(Lateness, IsUnknownBeforeTheFirst) {
    const Lateness lateness;
    EXPECT_FALSE(lateness.quantile(0.5));
    EXPECT_FALSE(lateness.max());
}

TEST(Lateness, TellsQuantilesAtMostNinePercentTooHigh) {
    Lateness lateness;
    for (int i = 1; i <= 1000; ++i)
        lateness.add(i * 10us);
    for (const double share : {0.1, 0.5, 0.9, 0.99}) {
        const std::chrono::duration<double, std::micro> told = *lateness.quantile(share);
        EXPECT_GE(told.count(), share * 10'000.0);
        EXPECT_LE(told.count(), share * 10'000.0 * 1.0906);
    }
}

TEST(Lateness, TellsTheMaximumExactlyAndNoQuantileAboveIt) {
    Lateness lateness;
    lateness.add(1001us);
    lateness.add(3us);
    EXPECT_EQ(lateness.max(), 1001us);
    EXPECT_EQ(lateness.quantile(1.0), 1001us);
    EXPECT_LE(*lateness.quantile(0.5), 4us);
}

TEST(Lateness, HoldsWhatIsTooEarlyOrVeryLate) {
    Lateness lateness;
    lateness.add(-5us);
    lateness.add(0us);
    EXPECT_EQ(lateness.quantile(1.0), 0us);
    lateness.add(1h);
    EXPECT_EQ(lateness.max(), 1h);
    EXPECT_GT(*lateness.quantile(1.0), 100s);
    EXPECT_EQ(lateness.sum(), 1h);
}

TEST(Lateness, AddsUpWithThatOfOthers) {
    Lateness lateness;
    lateness.add(3us);
    lateness.add(100us);
    Lateness other;
    other.add(5us);
    lateness += other;
    EXPECT_EQ(lateness.count(), 3U);
    EXPECT_EQ(lateness.below(1), 0U);
    EXPECT_EQ(lateness.below(2), 1U);
    EXPECT_EQ(lateness.below(3), 2U);
    EXPECT_EQ(lateness.below(7), 3U);
    EXPECT_EQ(lateness.sum(), 108us);
    EXPECT_EQ(lateness.max(), 100us);
}

}  // namespace
}  // namespace scipd::daemon
