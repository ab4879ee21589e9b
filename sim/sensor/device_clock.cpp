// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/device_clock.h"

#include <cassert>
#include <cmath>

namespace scipd::sim {
namespace {

// Only the small part goes through floating point: a nanosecond stays one after years.
Time share(Time time, double factor) {
    return Time(std::llround(static_cast<double>(time.count()) * factor));
}

}  // namespace

DeviceClock::DeviceClock(Time power_up, double ppm) : power_up_(power_up), gain_(ppm * 1e-6) {
    assert(std::abs(gain_) < 0.5);
}

Time DeviceClock::device_time(Time world) const {
    const Time elapsed = world - power_up_;
    return elapsed + share(elapsed, gain_);
}

Time DeviceClock::world_time(Time device) const {
    Time world = power_up_ + device - share(device, gain_ / (1.0 + gain_));
    // At most a nanosecond or two of rounding.
    while (device_time(world) < device)
        ++world;
    while (device_time(world - Time(1)) >= device)
        --world;
    return world;
}

}  // namespace scipd::sim
