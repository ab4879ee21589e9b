// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns true ranges into the ranges that a sensor reads. Pure: noise follows from the seed, the
// sensor and the revolution, so a scan does not depend on threads or on the client that asked.
#pragma once

#include <cstdint>
#include <span>

#include "sim/backends/fan.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// The paper's levels of accuracy.
enum class Accuracy { ideal, sensor };

struct ErrorModel {
    Accuracy accuracy = Accuracy::sensor;
    std::uint64_t seed = 0;
    std::uint64_t sensor = 0;  ///< stable over runs: derived from the sensor's name

    /// Fills range_m[i] from hits[i]; a ray that met nothing stays infinite.
    void read(const SensorSpec& spec, std::int64_t revolution, std::span<const Hit> hits,
              std::span<float> range_m) const;
};

}  // namespace scipd::sim
