// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When revolution n begins and when its beams are fired. Arithmetic only: the n-th instant is
// computed from n, never from the one before, so nothing drifts.
#pragma once

#include <cstdint>

#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"

namespace scipd::sim {

class ScanTiming {
  public:
    /// Revolution 0 passes step 0 at `epoch`.
    ScanTiming(const SensorSpec& spec, Time epoch);

    /// The instant of step 0.
    [[nodiscard]] Time start(std::int64_t revolution) const;
    [[nodiscard]] Time fired(std::int64_t revolution, int step) const;
    /// The last measured step has been fired: the scan is complete.
    [[nodiscard]] Time complete(std::int64_t revolution) const;
    /// The revolution that is under way at `time`; negative before the epoch.
    [[nodiscard]] std::int64_t revolution_at(Time time) const;
    /// The latest one that is complete at `time`; negative where none is yet.
    [[nodiscard]] std::int64_t latest_complete(Time time) const;

  private:
    Time epoch_;
    Time period_;
    Time last_fired_;  ///< after the start of a revolution
    int steps_per_turn_;
};

}  // namespace scipd::sim
