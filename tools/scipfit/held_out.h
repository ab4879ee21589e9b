// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a law of noise holds for scans and beams that it was not fitted to. Values; one thread.
#pragma once

#include <cstddef>
#include <optional>

#include "sim/sensor/sensor_spec.h"
#include "tools/scipfit/noise_fit.h"

namespace scipd::tools {

/// How well the fit tells what was not fitted: the other half of the time, at the other blocks of
/// beams, each around its own mean. Natural logarithms of densities per mm.
struct HeldOut {
    double coverage_95 = 0.0;
    double nll = 0.0;
    double nll_sheet = 0.0;     ///< with the data sheet's accuracy as the deviation
    double nll_constant = 0.0;  ///< with one deviation for all
    double nll_per_beam = 0.0;  ///< with each beam's own deviation: no law does better
    std::size_t readings = 0;
};

/// The accuracy that the data sheet states at this range; 0: none.
[[nodiscard]] double sheet_mm(const sim::SensorSpec& sheet, double range_mm);

[[nodiscard]] std::optional<HeldOut> held_out(const Standing& standing, const NoiseFit& fit,
                                              const sim::SensorSpec& sheet);

}  // namespace scipd::tools
