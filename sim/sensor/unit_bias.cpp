// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/unit_bias.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/random.h"
#include "sim/sensor/echo.h"

namespace scipd::sim {
namespace {

constexpr double typical_m = 0.010;
constexpr double nearest_m = 0.05;
constexpr int points_per_octave = 4;
/// Waves over the logarithm of the range, so that a curve bends more near by than far away.
constexpr std::array<double, 3> wave_octaves{8.0, 4.0, 2.5};
constexpr std::uint32_t walk_chance = 2 * wave_octaves.size();

Chance chance_of(std::uint64_t unit) {
    return Chance({.seed = unit, .purpose = Purpose::unit});
}

/// As before for small values, and never beyond the bound.
double held_within(double bound_m, double value_m) {
    return std::isinf(bound_m) ? value_m : bound_m * std::tanh(value_m / bound_m);
}

/// A sum of waves of this deviation.
double wave_m(const Chance& chance, double octaves) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < wave_octaves.size(); ++i) {
        const double turned = std::numbers::pi * chance.even(2 * i + 1);
        sum += chance.standard_normal(2 * i) *
               std::cos(2.0 * std::numbers::pi * octaves / wave_octaves[i] + turned);
    }
    return typical_m * sum * std::sqrt(2.0 / wave_octaves.size());
}

}  // namespace

std::vector<BiasPoint> unit_bias(const SensorSpec& spec, std::uint64_t unit) {
    const Chance chance = chance_of(unit);
    const double most_octaves = std::log2(std::max(spec.max_range_m, 1.0) / nearest_m);
    std::vector<BiasPoint> curve;
    for (int i = 0; i <= std::ceil(most_octaves * points_per_octave); ++i) {
        const double octaves = static_cast<double>(i) / points_per_octave;
        const double range_m = nearest_m * std::exp2(octaves);
        curve.push_back({range_m, held_within(spec.accuracy_m(range_m), wave_m(chance, octaves))});
    }
    return curve;
}

double unit_walk_m(const SensorSpec& spec, std::uint64_t unit) {
    return spec.receiver.walk_m * (1.0 + chance_of(unit).even(walk_chance));
}

float signal_of(const Receiver& receiver, float range_m, float power) {
    const float level_m = std::max(range_m, static_cast<float>(receiver.level_below_m));
    return power / (level_m * level_m);
}

double steady_error_m(const SensorSpec& spec, double range_m, double bias_m, const Light& light) {
    const Receiver& receiver = spec.receiver;
    // Light that is brighter than white drives no comparator sooner: beacons of film read as walls
    // do (SkoltechRobotics/Eurobot2018).
    const double walk_m =
        receiver.walk_m == 0.0 ? 0.0 : -receiver.walk_m * std::log10(std::min(light.power, 1.0));
    const double most_m = std::max(spec.accuracy_m(range_m), std::abs(bias_m));
    const double error_m = std::clamp(bias_m + walk_m, -most_m, most_m);
    if (receiver.saturating_signal <= 0.0 || light.signal <= receiver.saturating_signal)
        return error_m;
    return error_m + receiver.saturation_m * std::log10(light.signal / receiver.saturating_signal);
}

double steady_error_m(const SensorSpec& spec, const Reading& reading) {
    const double bias_m = spec.bias_m(reading.range_m);
    if (reading.signal <= 0.0F) return bias_m;
    const double power = reading.signal / signal_of(spec.receiver, reading.range_m, 1.0F);
    return steady_error_m(spec, reading.range_m, bias_m, {power, reading.signal});
}

float weakest_signal(const Receiver& receiver) {
    if (receiver.dark_range_m <= 0.0) return 0.0F;
    return signal_of(receiver, static_cast<float>(receiver.dark_range_m), dark_target);
}

}  // namespace scipd::sim
