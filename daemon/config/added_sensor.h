// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration with one sensor more, or less, than the one that runs. The new one is read as
// those of a file are, beside all others, so that no two can want the same port. Any thread;
// nothing shared.
#pragma once

#include <optional>
#include <string>

#include "daemon/config/config.h"

namespace scipd::daemon {

/// Its keys and their values are those of a configuration.
struct AddedSensor {
    std::string robot;
    std::string name;
    std::string keys;                       ///< a map in YAML or JSON: the model, its port, ..
    std::optional<std::string> robot_pose;  ///< of a robot that comes with it, such a map as well
};

/// There is no sensor of this name. A robot that is not there yet comes with it. Throws
/// sim::LoadError with every fault, "KEY: why" where it is one of the keys.
Config with_sensor(const Config& now, const AddedSensor& added);

/// A robot without sensors is none, and goes with its last one. There is such a sensor, and another
/// one.
Config without_sensor(const Config& now, const std::string& robot, const std::string& sensor);

}  // namespace scipd::daemon
