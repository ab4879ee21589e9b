// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where in its turn a mirror is when the scanner is switched on.
#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

SensorConfig in_phase(sim::Time phase, PowerUp power_up = PowerUp::scip2) {
    SensorConfig config = ideal_sensor();
    config.clock.phase = phase;
    config.power_up = power_up;
    return config;
}

// Revolutions are counted from that pass on, and each scan leaves when its own last step is fired.
TEST(Phase, SaysWhenTheMirrorFirstPassesStepZero) {
    SteppedClock clock;
    World world = wall_world();
    const Device device("robot", in_phase(7ms), 1, world, clock);
    EXPECT_EQ(device.start_of(0), 7ms);
    EXPECT_EQ(device.start_of(3), 82ms);
    EXPECT_EQ(device.next_revolution(), 0);
    const Device other("robot", in_phase(0ms), 1, world, clock);
    EXPECT_NEAR(static_cast<double>((device.leaves(3) - other.leaves(3)).count()), 7e6, 1e6);
}

TEST(Phase, HoldsForAScannerThatBoots) {
    SteppedClock clock;
    World world = wall_world();
    Device device("robot", in_phase(7ms, PowerUp::boot), 1, world, clock);
    clock.advance_to(60s);
    EXPECT_EQ((device.start_of(device.next_revolution()) - 7ms) % 25ms, 0ms);
}

/// Goes on with each look at it, as the wall clock does on a machine that is busy.
class HastyClock : public SteppedClock {
  public:
    [[nodiscard]] sim::Time now() const override { return now_ += 9ms; }

  private:
    mutable sim::Time now_{};
};

TEST(Phase, DoesNotDependOnHowLongTheDaemonTakesToMakeTheScanner) {
    for (const PowerUp power_up : {PowerUp::scip2, PowerUp::boot}) {
        World world = wall_world();
        SteppedClock calm;
        const Device expected("robot", in_phase(7ms, power_up), 1, world, calm);
        HastyClock hasty;
        const Device device("robot", in_phase(7ms, power_up), 1, world, hasty);
        EXPECT_EQ(device.start_of(0), expected.start_of(0));
        EXPECT_EQ(device.state().clock_zero(), expected.state().clock_zero());
        EXPECT_EQ(device.state().booted_at(), expected.state().booted_at());
    }
}

}  // namespace
}  // namespace scipd::daemon
