// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The standard deviation of a range, by the light that comes back (noise_law.h). Made for one scan.
#pragma once

#include "sim/sensor/curve.h"
#include "sim/sensor/echo.h"
#include "sim/sensor/noise_law.h"
#include "sim/sensor/spec_curves.h"

namespace scipd::sim {

/// How much of the spread of ranges within a footprint shows as noise. Recorded walls that are met
/// at 40 to 75 degrees leave no room for more.
inline constexpr double spread_share = 0.02;

class Deviation {
  public:
    /// So many times what `curves` say, which must outlive it.
    Deviation(const NoiseLaw& law, const SpecCurves& curves, double factor);

    /// For a white wall that is met head-on.
    [[nodiscard]] double of_white_wall_m(double range_m) {
        return factor_ * white_wall_.at(range_m);
    }

    /// Light of less power than a white wall's leaves more noise: at most as much as that of the
    /// darkest target that is still seen.
    [[nodiscard]] double of_m(const Echo& echo);

  private:
    double factor_;
    double weak_;
    double faintest_intensity_;
    Curve::Cursor white_wall_;
    Curve::Cursor intensity_;
};

}  // namespace scipd::sim
