// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/medium.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

// The visibility is the distance at which a contrast has fallen to 2 %.
TEST(Medium, FogHidesThingsAtItsVisibility) {
    for (const double visibility_m : {10.0, 50.0, 400.0})
        EXPECT_NEAR(std::exp(-fog(visibility_m).extinction_per_m * visibility_m), 0.02, 1e-4);
}

// The drops of Marshall and Palmer, counted one diameter after the other.
TEST(Medium, RainTakesTwiceWhatFallsOnItsDrops) {
    for (const double mm_per_hour : {1.0, 10.0, 50.0}) {
        double sum_m2_per_m3 = 0.0;
        constexpr double step_mm = 1e-3;
        for (double diameter_mm = 0.0; diameter_mm < 20.0; diameter_mm += step_mm) {
            const double drops =
                8000.0 * std::exp(-4.1 * std::pow(mm_per_hour, -0.21) * diameter_mm) * step_mm;
            sum_m2_per_m3 += drops * 3.14159265 / 4.0 * diameter_mm * diameter_mm * 1e-6;
        }
        EXPECT_NEAR(rain(mm_per_hour).extinction_per_m, 2.0 * sum_m2_per_m3, 0.01 * sum_m2_per_m3)
            << mm_per_hour;
    }
}

TEST(Medium, GrowsThickerWithTheWeather) {
    EXPECT_GT(rain(50).extinction_per_m, rain(5).extinction_per_m);
    EXPECT_GT(snow(5).extinction_per_m, rain(5).extinction_per_m);
    EXPECT_GT(dust(10).extinction_per_m, dust(100).extinction_per_m);
}

}  // namespace
}  // namespace scipd::sim
