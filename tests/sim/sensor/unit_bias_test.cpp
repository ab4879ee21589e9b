// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/unit_bias.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr int units = 500;

SensorSpec spec() {
    return {.max_range_m = 30.0, .receiver = {.walk_m = 0.01}};
}

double bias_at(SensorSpec spec, std::uint64_t unit, double range_m) {
    spec.bias = unit_bias(spec, unit);
    return spec.bias_m(range_m);
}

TEST(UnitBias, IsTenMillimetresWideAndNoneOnAverage) {
    for (const double range_m : {0.1, 0.5, 2.0, 10.0, 30.0}) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint64_t unit = 0; unit < units; ++unit) {
            const double bias_m = bias_at(spec(), unit, range_m);
            sum += bias_m;
            squares += bias_m * bias_m;
        }
        EXPECT_NEAR(sum / units, 0.0, 5 * 0.010 / std::sqrt(units)) << range_m;
        // Chances multiply, so the tails are wider than those of a normal distribution.
        EXPECT_NEAR(std::sqrt(squares / units), 0.010, 0.0020) << range_m;
    }
}

TEST(UnitBias, IsThatOfTheUnit) {
    EXPECT_EQ(unit_bias(spec(), 7), unit_bias(spec(), 7));
    EXPECT_NE(unit_bias(spec(), 7), unit_bias(spec(), 8));
}

TEST(UnitBias, StaysWithinTheDataSheet) {
    SensorSpec tight = spec();
    tight.accuracy = {{0.0, 0.010, 0.0}, {1.0, 0.0, 0.01}};
    for (std::uint64_t unit = 0; unit < units; ++unit) {
        for (const double range_m : {0.06, 0.2, 0.9, 1.2, 3.0, 5.6})
            EXPECT_LE(std::abs(bias_at(tight, unit, range_m)), std::max(0.010, 0.012 * range_m));
    }
}

// Within a tenth of the range no unit's bias changes by more than a few millimetres.
TEST(UnitBias, IsSmooth) {
    for (std::uint64_t unit = 0; unit < units; ++unit) {
        for (double range_m = 0.1; range_m < 25.0; range_m *= 1.1) {
            const double change_m =
                bias_at(spec(), unit, 1.1 * range_m) - bias_at(spec(), unit, range_m);
            EXPECT_LT(std::abs(change_m), 0.015) << unit << " at " << range_m;
        }
    }
}

TEST(UnitBias, HasAWalkBetweenNoneAndTwice) {
    double least = 1.0;
    double most = 0.0;
    for (std::uint64_t unit = 0; unit < units; ++unit) {
        least = std::min(least, unit_walk_m(spec(), unit));
        most = std::max(most, unit_walk_m(spec(), unit));
    }
    EXPECT_GE(least, 0.0);
    EXPECT_LT(least, 0.001);
    EXPECT_LE(most, 0.020);
    EXPECT_GT(most, 0.019);
}

}  // namespace
}  // namespace scipd::sim
