// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/deviation.h"

#include <algorithm>
#include <cmath>

namespace scipd::sim {
namespace {

double square(double x) {
    return x * x;
}

}  // namespace

Deviation::Deviation(const NoiseLaw& law, const SpecCurves& curves, double factor)
    : factor_(factor),
      weak_(law.weak),
      faintest_intensity_(curves.faintest_intensity),
      white_wall_(curves.white_wall),
      intensity_(curves.intensity) {}

double Deviation::of_m(const Echo& echo) {
    double variance_m2 = square(white_wall_.at(echo.range_m));
    if (const double white = intensity_.at(echo.range_m); white > 0.0) {
        const double intensity = std::max(white * echo.power, faintest_intensity_);
        variance_m2 *= (1.0 + square(weak_ / intensity)) / (1.0 + square(weak_ / white));
    }
    return factor_ * std::sqrt(variance_m2 + square(spread_share * echo.spread_m));
}

}  // namespace scipd::sim
