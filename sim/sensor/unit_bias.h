// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Errors that stay the same over scans: the signal of an echo and its bias, and the bias of one
// unit of a product, a smooth curve over the range as its owner would find it by calibration. Any
// thread; nothing shared.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/sensor/reading.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// Typical size: 10 mm, as recorded of single units (docs/errors.md), and within the accuracy of
/// the data sheet. `unit` is a number of the unit, such as a hash of its serial number.
[[nodiscard]] std::vector<BiasPoint> unit_bias(const SensorSpec& spec, std::uint64_t unit);

/// How the range of this unit depends on the light: 0 to 2 times the product's walk error.
[[nodiscard]] double unit_walk_m(const SensorSpec& spec, std::uint64_t unit);

/// The signal of an echo: its light falls with the square of the range. Nearer than the receiver's
/// level range it stays as it is there.
[[nodiscard]] float signal_of(const Receiver& receiver, float range_m, float power);

struct Light {
    double power;   ///< as of an Echo
    double signal;  ///< signal_of() it
};

/// The error of a unit for such light, without its random part: its bias at this range and its
/// walk, which together stay within the data sheet's accuracy unless the bias alone does not, and
/// what too strong a signal adds.
[[nodiscard]] double steady_error_m(const SensorSpec& spec, double range_m, double bias_m,
                                    const Light& light);

/// The same for the sensor that read this, without its drift while it warms up.
[[nodiscard]] double steady_error_m(const SensorSpec& spec, const Reading& reading);

/// The weakest signal that the receiver notices half the time; 0: it notices all.
[[nodiscard]] float weakest_signal(const Receiver& receiver);

/// Below and above weakest_signal() the share of echoes that are noticed goes from none to all as
/// the normal distribution of the signal's logarithm with this deviation. Assumed.
inline constexpr double noticing_spread = 0.05;

}  // namespace scipd::sim
