// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_spec.h"

#include <algorithm>
#include <numbers>

#include "sim/sensor/curve.h"

namespace scipd::sim {

double SensorSpec::angle_rad(double step) const {
    return 2.0 * std::numbers::pi * (step - front_step) / steps_per_turn;
}

double SensorSpec::sigma_m(double range_m) const {
    return Curve(noise).at(range_m);
}

double SensorSpec::bias_m(double range_m) const {
    return Curve(bias, &BiasPoint::bias_m).at(range_m);
}

double SensorSpec::intensity(double range_m, double power) const {
    const double white = Curve(receiver.intensity, &IntensityPoint::intensity).at(range_m);
    return std::min(white * power, receiver.most_intensity);
}

}  // namespace scipd::sim
