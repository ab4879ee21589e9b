// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/reading_errors.h"

#include <utility>

namespace scipd::daemon {

ReadingErrors errors_of(const SensorConfig& sensor) {
    const bool own_bias = sensor.model.own_bias;
    return {sensor.accuracy, sensor.noise, sensor.interference, own_bias,
            own_bias ? sensor.model.optics.bias : std::vector<sim::BiasPoint>{}};
}

void set_errors(SensorConfig& sensor, ReadingErrors errors) {
    sensor.accuracy = errors.accuracy;
    sensor.noise = errors.noise;
    sensor.interference = errors.interference;
    sensor.model.own_bias = errors.own_bias;
    sensor.model.optics.bias = std::move(errors.bias);
}

}  // namespace scipd::daemon
