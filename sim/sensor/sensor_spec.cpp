// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_spec.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace scipd::sim {
namespace {

/// The value of a curve at this range; 0 where it has no points.
template <class Point>
double on_curve(const std::vector<Point>& curve, double Point::*value, double range_m) {
    if (curve.empty()) return 0.0;
    const auto after = std::ranges::upper_bound(curve, range_m, {}, &Point::range_m);
    if (after == curve.begin()) return curve.front().*value;
    if (after == curve.end()) return curve.back().*value;
    const Point& before = *std::prev(after);
    const double share = (range_m - before.range_m) / (after->range_m - before.range_m);
    return std::lerp(before.*value, (*after).*value, share);
}

}  // namespace

double SensorSpec::angle_rad(int step) const {
    return 2.0 * std::numbers::pi * (step - front_step) / steps_per_turn;
}

double SensorSpec::sigma_m(double range_m) const {
    const auto after = std::ranges::upper_bound(noise, range_m, {}, &NoiseStep::from_range_m);
    if (after == noise.begin()) return 0.0;
    const NoiseStep& step = *std::prev(after);
    return step.sigma_m + step.sigma_share * range_m;
}

double SensorSpec::bias_m(double range_m) const {
    return on_curve(bias, &BiasPoint::bias_m, range_m);
}

double SensorSpec::intensity(double range_m, double power) const {
    const double white = on_curve(receiver.intensity, &IntensityPoint::intensity, range_m);
    return std::min(white * power, receiver.most_intensity);
}

}  // namespace scipd::sim
