// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the beams of a sensor look, as it is configured. Any thread.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "daemon/config/sensor_config.h"

namespace scipd::daemon {

/// Unit vectors, in the order in which they are cast.
std::vector<glm::vec3> directions_of(const SensorConfig& sensor);

}  // namespace scipd::daemon
