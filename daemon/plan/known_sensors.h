// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is known of the sensors that run, for a configuration that comes: it need not be found out
// again. Values; any thread.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "daemon/config/sensor_config.h"
#include "daemon/world/backend_choice.h"

namespace scipd::daemon {

/// It holds while the configuration of the sensor stays the same.
struct KnownSensor {
    SensorConfig config;
    SharedChoice choice;  ///< what `auto` has been settled as
    /// How long a sweep of it takes, on the average; nothing: it has made none.
    std::optional<std::chrono::duration<double>> sweep;
};

/// By name.
using KnownSensors = std::map<std::string, KnownSensor>;

/// Null: nothing is known of a sensor of this name that is configured like this.
[[nodiscard]] inline const KnownSensor* find_known(const KnownSensors& known,
                                                   const std::string& name,
                                                   const SensorConfig& config) {
    const auto found = known.find(name);
    return found != known.end() && found->second.config == config ? &found->second : nullptr;
}

}  // namespace scipd::daemon
