// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "sim/time.h"

namespace scipd::sim {

/// A scanner's own clock: its crystal, which drives the mirror, the ticks that replies leave on and
/// the counter of the time stamps. It runs evenly but at a rate of its own. What is zero on the
/// wire, and that 24 bits wrap, is protocol's.
class DeviceClock {
  public:
    /// Reads 0 at `power_up` of world time and gains `ppm` microseconds a second; |ppm| is well
    /// below a million.
    DeviceClock(Time power_up, double ppm);

    [[nodiscard]] Time device_time(Time world) const;
    /// The first instant at which it reads `device` or more.
    [[nodiscard]] Time world_time(Time device) const;

  private:
    Time power_up_;
    double gain_;
};

}  // namespace scipd::sim
