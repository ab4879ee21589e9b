// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How much the distances vary: the law with intervals. Values; one thread.
#pragma once

#include <optional>

#include "tools/scipfit/law_fit.h"
#include "tools/scipfit/unknown.h"

namespace scipd::tools {

/// What a recording has, for the estimates that follow.
struct Standing {
    const ScanTable* readings = nullptr;
    std::vector<Station> stations;
    std::vector<StationSums> sums;
};

struct NoiseFit {
    NoiseModel model;
    Interval s0_mm;
    Interval i0;                  ///< where the law is by intensity
    std::vector<Interval> steps;  ///< as many as model.steps
    double spread = 0.0;          ///< between beams, of the logarithm of the variance
    std::vector<LawSample> samples;
    LawSample nearest, farthest;  ///< of the samples
    double dimmest = 0.0;
    double brightest = 0.0;
};

/// Nothing where the recording does not tell; then, and where it does not tell a part, `unknown`
/// says why. `start` says of medians and rounding.
[[nodiscard]] std::optional<NoiseFit> fit_noise(const Standing& standing, const NoiseModel& start,
                                                Unknowns& unknown);

/// A model of the same kind, with the same steps, fitted to these samples.
[[nodiscard]] NoiseModel fit_model(const std::vector<LawSample>& samples, NoiseModel kind);

}  // namespace scipd::tools
