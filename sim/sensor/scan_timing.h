// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When revolution n begins and when its beams are fired, in the device's own time. Arithmetic only:
// the n-th instant is computed from n and from when the speed last changed, never from the one
// before, so nothing drifts.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"

namespace scipd::sim {

class ScanTiming {
  public:
    /// Revolution 0 passes step 0 at `epoch`.
    ScanTiming(const SensorSpec& spec, Time epoch);

    /// From `origin` on, a pass of step 0, a turn takes `period`. A turn that is under way then
    /// ends there; everything earlier stays as it was. No effect where it turns so already.
    void turn_from(Time origin, Time period);

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
    /// Turns at one speed.
    struct Spell {
        std::int64_t first = 0;  ///< revolution, begins at `origin`
        Time origin{};
        Time period{};
    };
    [[nodiscard]] const Spell& spell_of(std::int64_t revolution) const;

    int steps_per_turn_;
    int last_step_;
    std::vector<Spell> spells_;  ///< in order; the first one reaches back for ever
};

}  // namespace scipd::sim
