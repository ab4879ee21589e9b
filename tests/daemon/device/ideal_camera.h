// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>
#include <cmath>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// "tof": one row of pixels across a right angle, every 40 ms, without noise, all at one instant.
inline SensorConfig ideal_camera(int columns, double max_range_m) {
    SensorConfig config;
    config.name = "tof";
    config.accuracy = sim::Accuracy::ideal;
    config.motion = 1;
    config.staring =
        sim::StaringSpec{.optics = sim::PinholeGrid{columns, 1, 2 * std::atan(1.0), 0.1},
                         .period = std::chrono::milliseconds(40),
                         .min_range_m = 0.1,
                         .max_range_m = max_range_m};
    return config;
}

}  // namespace scipd::daemon
