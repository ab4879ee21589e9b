// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>

#include "sim/time.h"

namespace scipd::daemon {

/// The wall clock as world time: 0 where it was made. The only place that reads a clock for the
/// simulation.
class Clock {
  public:
    using Steady = std::chrono::steady_clock;

    [[nodiscard]] sim::Time now() const { return Steady::now() - epoch_; }
    /// What a timer has to wait for.
    [[nodiscard]] Steady::time_point when(sim::Time time) const { return epoch_ + time; }

  private:
    Steady::time_point epoch_ = Steady::now();
};

}  // namespace scipd::daemon
