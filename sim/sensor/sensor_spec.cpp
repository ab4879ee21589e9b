// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/sensor_spec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/sensor/curve.h"

namespace scipd::sim {

namespace {

struct NoisePoint {
    double range_m;
    double sigma_m;
};

/// The points of an intensity curve, with others between: the law bends where that is straight.
std::vector<IntensityPoint> closer(const std::vector<IntensityPoint>& points) {
    constexpr int parts = 3;
    std::vector<IntensityPoint> closer;
    closer.reserve(parts * points.size() + 1);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        for (int part = 0; part < parts; ++part) {
            const double share = static_cast<double>(part) / parts;
            closer.push_back({std::lerp(points[i].range_m, points[i + 1].range_m, share),
                              std::lerp(points[i].intensity, points[i + 1].intensity, share)});
        }
    }
    if (!points.empty()) closer.push_back(points.back());
    return closer;
}

}  // namespace

double SensorSpec::angle_rad(double step) const {
    return 2.0 * std::numbers::pi * (step - front_step) / steps_per_turn;
}

double SensorSpec::beam_rad() const {
    return 2.0 * std::numbers::pi / steps_per_turn;
}

double SensorSpec::sigma_m(double range_m) const {
    return white_wall_noise(*this).at(range_m);
}

double SensorSpec::bias_m(double range_m) const {
    return Curve(bias, &BiasPoint::bias_m).at(range_m);
}

double SensorSpec::accuracy_m(double range_m) const {
    double bound_m = std::numeric_limits<double>::infinity();
    for (const AccuracyStep& step : accuracy) {
        if (range_m >= step.from_range_m) bound_m = step.bound_m + step.bound_share * range_m;
    }
    return bound_m;
}

double SensorSpec::intensity(double range_m, double power) const {
    const double white = Curve(receiver.intensity, &IntensityPoint::intensity).at(range_m);
    return std::min(white * receiver.brightness(power), receiver.most_intensity);
}

double SensorSpec::faintest_intensity() const {
    return intensity(receiver.dark_range_m, dark_target);
}

double Receiver::brightness(double power) const {
    return power <= 1.0 || log_gain == 0.0 ? power : 1.0 + log_gain * std::log(power);
}

Curve white_wall_noise(const SensorSpec& spec) {
    if (!spec.noise.empty()) return Curve(spec.noise);
    const auto& [floor_m, weak] = spec.noise_law;
    std::vector<NoisePoint> points;
    for (const auto& [range_m, intensity] : closer(spec.receiver.intensity))
        points.push_back(
            {range_m, floor_m * std::sqrt(1.0 + (weak / intensity) * (weak / intensity))});
    if (points.empty()) points.push_back({0.0, floor_m});
    return Curve(points, &NoisePoint::sigma_m);
}

}  // namespace scipd::sim
