// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/device_clock.h"

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using namespace std::chrono_literals;

TEST(DeviceClock, ReadsTheTimeSincePowerUp) {
    const DeviceClock clock(5s, 0.0);
    EXPECT_EQ(clock.device_time(5s), 0s);
    EXPECT_EQ(clock.device_time(7s + 1ns), 2s + 1ns);
    EXPECT_EQ(clock.world_time(2s + 1ns), 7s + 1ns);
}

TEST(DeviceClock, GainsItsPartsPerMillion) {
    const DeviceClock fast(1s, 50.0);
    EXPECT_EQ(fast.device_time(1s + 1h), 1h + 180ms);  // 3600 s x 50 ppm
    const DeviceClock slow(1s, -0.5);
    EXPECT_EQ(slow.device_time(1s + 1000h), 1000h - 1800ms);
}

TEST(DeviceClock, TellsTheFirstInstantThatReadsATime) {
    for (const double ppm : {-10'000.0, -50.0, -0.1, 0.0, 0.1, 50.0, 10'000.0}) {
        const DeviceClock clock(3s, ppm);
        for (const Time device : {Time(0), Time(1), Time(999'999'937), Time(25ms), Time(1h + 7ns),
                                  Time(24h * 365 * 5 + 13ns)}) {
            const Time world = clock.world_time(device);
            EXPECT_GE(clock.device_time(world), device) << ppm;
            EXPECT_LT(clock.device_time(world - 1ns), device) << ppm;
        }
    }
}

}  // namespace
}  // namespace scipd::sim
