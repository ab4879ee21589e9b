// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/scan_timing.h"

#include <cassert>

namespace scipd::sim {
namespace {

/// Rounded down, also below zero.
std::int64_t whole_periods(Time time, Time period) {
    const std::int64_t toward_zero = time / period;
    return time % period < Time::zero() ? toward_zero - 1 : toward_zero;
}

}  // namespace

ScanTiming::ScanTiming(const SensorSpec& spec, Time epoch)
    : epoch_(epoch),
      period_(spec.scan_period),
      last_fired_(spec.scan_period * spec.last_step / spec.steps_per_turn),
      steps_per_turn_(spec.steps_per_turn) {
    assert(period_ > Time::zero());
}

Time ScanTiming::start(std::int64_t revolution) const {
    return epoch_ + revolution * period_;
}

Time ScanTiming::fired(std::int64_t revolution, int step) const {
    return start(revolution) + period_ * step / steps_per_turn_;
}

Time ScanTiming::complete(std::int64_t revolution) const {
    return start(revolution) + last_fired_;
}

std::int64_t ScanTiming::revolution_at(Time time) const {
    return whole_periods(time - epoch_, period_);
}

std::int64_t ScanTiming::latest_complete(Time time) const {
    return whole_periods(time - epoch_ - last_fired_, period_);
}

}  // namespace scipd::sim
