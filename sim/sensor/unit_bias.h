// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one unit of a product reads too far, as its owner would find it by calibration: a smooth
// curve over the range that is constant for the unit, and differs from one unit to the next. Any
// thread; nothing shared.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// Typical size: 10 mm, as recorded of single units (docs/errors.md), and within the accuracy of
/// the data sheet. `unit` is a number of the unit, such as a hash of its serial number.
[[nodiscard]] std::vector<BiasPoint> unit_bias(const SensorSpec& spec, std::uint64_t unit);

/// How the range of this unit depends on the light: 0 to 2 times the product's walk error.
[[nodiscard]] double unit_walk_m(const SensorSpec& spec, std::uint64_t unit);

}  // namespace scipd::sim
