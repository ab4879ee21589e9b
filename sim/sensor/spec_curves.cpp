// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/spec_curves.h"

namespace scipd::sim {

SpecCurves::SpecCurves(const SensorSpec& spec)
    : bias(spec.bias, &BiasPoint::bias_m),
      white_wall(white_wall_noise(spec)),
      intensity(spec.receiver.intensity, &IntensityPoint::intensity),
      intensity_noise(spec.receiver.intensity_noise, &IntensityNoisePoint::share,
                      &IntensityNoisePoint::intensity),
      faintest_intensity(spec.faintest_intensity()) {}

}  // namespace scipd::sim
