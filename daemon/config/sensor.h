// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One sensor of a configuration: its keys, and which of them go together. One thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "daemon/config/claims.h"
#include "daemon/config/config.h"
#include "daemon/config/models.h"
#include "daemon/config/section.h"

namespace scipd::daemon {

/// What all sensors of a document are read with.
struct SensorContext {
    const ModelChoice& models;
    Claims& claims;
    std::filesystem::path base;  ///< of relative paths
    Faults& faults;
    std::map<std::string, std::string>& places;  ///< as of Config
    std::string robot = {};                      ///< whose sensors are read
};

/// Throws std::invalid_argument, with what to do, where the model cannot power up so.
void check_power_up(PowerUp power_up, const protocol::DeviceProfile& profile);

SensorConfig read_sensor(const Field& field, SensorContext& context);

}  // namespace scipd::daemon
