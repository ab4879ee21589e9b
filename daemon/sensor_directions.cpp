// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/sensor_directions.h"

#include "sim/sensor/beam_pattern.h"

namespace scipd::daemon {

std::vector<glm::vec3> directions_of(const SensorConfig& sensor) {
    if (sensor.staring) return sensor.staring->directions();
    const sim::BeamPattern pattern(sensor.model.optics);
    return {pattern.directions().begin(), pattern.directions().end()};
}

}  // namespace scipd::daemon
