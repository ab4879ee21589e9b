// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How neighbouring beams, and consecutive scans, share their noise; and which smoothing of scipd's
// (sim/sensor/noise_law.h) does the same. Values; one thread.
#pragma once

#include <array>
#include <vector>

#include "sim/sensor/noise_law.h"
#include "tools/scipfit/block_sums.h"

namespace scipd::tools {

struct SmoothingFit {
    std::array<Interval, most_lag> beside{};  ///< correlations with the next beams, on flat walls
    Interval after{};                         ///< and with the scan after
    double equal = 0.0;            ///< the share of neighbours on flat walls that read the same
    double equal_by_chance = 0.0;  ///< the share that noise of these correlations would have
    std::size_t pairs = 0;         ///< of neighbouring beams
    sim::Smoothing smoothing{};
};

/// `rounding_mm2`: the variance that whole millimetres and a lattice add; `place_mm`: how far apart
/// two distances are that differ.
[[nodiscard]] SmoothingFit fit_smoothing(const std::vector<Station>& stations,
                                         const std::vector<StationSums>& sums, double rounding_mm2,
                                         double place_mm);

/// The correlations that a smoothing leaves on a flat wall.
[[nodiscard]] std::array<double, most_lag> correlations_of(const sim::Smoothing& smoothing);

}  // namespace scipd::tools
