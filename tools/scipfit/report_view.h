// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the pictures of a report show: the noise of each beam beside what the law says, how the
// residuals are distributed, and how the recording's halves differ. Values; one thread.
#pragma once

#include <optional>
#include <vector>

#include "tools/scipfit/fit.h"
#include "tools/scipfit/room_fit.h"
#include "tools/scipfit/simulated_noise.h"

namespace scipd::tools {

/// One beam at one station, and what would be expected there.
struct BeamNoise {
    int step = 0;
    bool of_longest = false;  ///< of the station that stands longest
    double range_mm = 0.0;
    double intensity = 0.0;
    double sd_mm = 0.0;
    double law_mm = 0.0;    ///< with rounding and slope and all
    double sheet_mm = 0.0;  ///< the accuracy of the data sheet; 0: none
};

/// A share of the residuals, in deviations that the law says, lies below `seen`; of a normal
/// distribution it lies below `normal`.
struct Quantile {
    double normal = 0.0;
    double seen = 0.0;
};

struct ReportView {
    std::vector<BeamNoise> beams;
    std::vector<Quantile> quantiles;
    // How much the first half of the time differs from the second: 19 of 20 beams by less.
    double floor_mean_mm = 0.0;
    double floor_sd_mm = 0.0;
    std::optional<NoisePiece> piece;
};

[[nodiscard]] ReportView view_of(const Standing& standing, const Fit& fit);

}  // namespace scipd::tools
