// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a sensor sits on its robot, as numbers or by the name of a place that the world has. Any
// thread; nothing shared.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "daemon/config/sensor_config.h"
#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// Reads the key `mount`: {xyz: [..], rpy: [..]}. They count from the place that `link: NAME` or
/// `sensor: NAME` names, else from the robot. `places` is that of Config.
void read_mount(const sim::YamlSection& section, SensorConfig& sensor, sim::YamlFaults& faults,
                std::map<std::string, std::string>& places);

/// X,Y,Z,ROLL,PITCH,YAW or a NAME. Three numbers are refused: they could be X,Y,Z or X,Y,YAW.
[[nodiscard]] sim::Expected<> take_mount(std::string_view text, SensorConfig& sensor);

}  // namespace scipd::daemon
