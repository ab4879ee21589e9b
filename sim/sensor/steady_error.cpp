// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/steady_error.h"

#include <algorithm>
#include <cmath>

#include "sim/sensor/echo.h"

namespace scipd::sim {

float signal_of(const Receiver& receiver, float range_m, float power) {
    const float level_m = std::max(range_m, static_cast<float>(receiver.level_below_m));
    return power / (level_m * level_m);
}

double steady_error_m(const SensorSpec& spec, double range_m, double bias_m, const Light& light) {
    const Receiver& receiver = spec.receiver;
    // What is brighter than white drives no comparator sooner: beacons of film read as walls do
    // (SkoltechRobotics/Eurobot2018).
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
