// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The unit of ranges whose file does not tell it. Any thread; nothing shared.
#pragma once

#include <cmath>
#include <cstddef>

#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim {

/// A guess by all ranges that are shown to it.
class LikelyUnit {
  public:
    /// `point`: it is written with one, or as what holds fractions.
    void show(double range, bool point) {
        // Codes of SCIP stand for no distance, and 0 for none at all.
        constexpr double codes = 20;
        constexpr double farthest_m = 100;
        if (!std::isfinite(range)) return;
        points_ = points_ || point;
        if (range < codes && range == std::floor(range)) return;
        ++(range > farthest_m ? beyond_ : within_);
    }

    /// Millimetres if none has a point, or if most, taken as metres, are farther than scanners see.
    [[nodiscard]] RangeUnit unit() const {
        return !points_ || beyond_ > within_ ? RangeUnit::millimetres : RangeUnit::metres;
    }

  private:
    bool points_ = false;
    std::size_t beyond_ = 0;
    std::size_t within_ = 0;
};

}  // namespace scipd::sim
