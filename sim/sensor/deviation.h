// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The standard deviation of a range, by the light that comes back (noise_law.h). Made for one scan;
// any thread.
#pragma once

#include "sim/sensor/curve.h"
#include "sim/sensor/echo.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// How much of the spread of ranges within a footprint shows as noise. Recorded walls that are met
/// at 40 to 75 degrees leave no room for more.
inline constexpr double spread_share = 0.02;

class Deviation {
  public:
    /// So many times what `spec` says.
    Deviation(const SensorSpec& spec, double factor);

    /// By range, of a white wall that is met head-on.
    [[nodiscard]] Curve::Cursor white_wall() const { return Curve::Cursor(white_wall_); }
    [[nodiscard]] double white_wall_m(double range_m, Curve::Cursor& cursor) const {
        return factor_ * cursor.at(range_m);
    }

    /// Light of less power than a white wall's leaves more noise: at most as much as that of the
    /// darkest target that is still seen.
    [[nodiscard]] double of_m(const Echo& echo) const;

  private:
    double factor_;
    double weak_;
    double faintest_intensity_;
    Curve white_wall_;
    Curve intensity_;
};

}  // namespace scipd::sim
