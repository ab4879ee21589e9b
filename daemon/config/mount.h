// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a sensor sits on its robot, as numbers or by the name of a place that the world has. Any
// thread; nothing shared.
#pragma once

#include <string_view>

#include "daemon/config/sensor.h"

namespace scipd::daemon {

/// The key `mount`: {xyz: [..], rpy: [..]}, and {link: NAME} or {sensor: NAME} from which they
/// count.
void read_mount(const Section& section, SensorConfig& sensor, SensorContext& context);

/// X,Y,YAW, X,Y,Z,ROLL,PITCH,YAW or a NAME. Throws std::invalid_argument.
void take_mount(std::string_view text, SensorConfig& sensor);

}  // namespace scipd::daemon
