// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The deviation of ranges as a law: by the intensity, s0 * sqrt(1 + (i0 / intensity)²), or by the
// range where that is not known. Values; one thread.
#pragma once

#include <vector>

#include "sim/sensor/noise_law.h"
#include "tools/scipfit/block_sums.h"
#include "tools/scipfit/rank.h"

namespace scipd::tools {

/// What one beam at one station has.
struct LawSample {
    double range_mm = 0.0;
    double intensity = 0.0;
    double slope_mm = 0.0;
    double variance_mm2 = 0.0;  ///< as measured, with what rounding adds
    double freedom = 0.0;       ///< degrees of it
};

struct NoiseAt {
    double from_mm = 0.0;
    double sigma_mm = 0.0;
};

struct NoiseModel {
    bool by_intensity = false;
    double s0_mm = 0.0;
    double i0 = 0.0;
    std::vector<NoiseAt> steps;  ///< by range, in place of s0 and i0
    bool median_of_five = false;
    double rounding_mm2 = 0.0;

    /// The noise at a wall that is met head-on.
    [[nodiscard]] double sigma_mm(double range_mm, double intensity) const;
    /// The noise of what the scanner says of this wall, rounding and slope and all.
    [[nodiscard]] double told_mm(const LawSample& sample) const;
};

/// Whether a beam tells of noise: inside a face that is not too steep, and where noise goes by the
/// intensity, one that has one: of several recordings some may have none.
[[nodiscard]] bool tells_noise(const Beam& beam, double beam_rad, bool by_intensity);

/// Those beams. `weights` choose the blocks.
[[nodiscard]] std::vector<LawSample> samples_of(const std::vector<Station>& stations,
                                                const std::vector<StationSums>& sums,
                                                double beam_rad, const Weights& weights,
                                                bool by_intensity);

struct LawFit {
    double s0_mm = 0.0;
    double i0 = 0.0;
    double spread = 0.0;  ///< of the logarithms of variances, beyond what chance leaves
    Jacobian jacobian;    ///< by the logarithms of s0 and i0
    double cost = 0.0;    ///< half the sum of the squares that are left, in units of chance
};

/// Fits to the samples what `start` says of rounding and medians. `with_light`: i0 as well.
[[nodiscard]] LawFit fit_law(const std::vector<LawSample>& samples, const NoiseModel& start,
                             bool with_light);

}  // namespace scipd::tools
