// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a configured scanner says of itself once it is switched on: its model's profile, with the
// timing and the bit rate that the configuration asks for. Pure.
#pragma once

#include "daemon/config/sensor_config.h"
#include "daemon/device/unit.h"
#include "protocol/device_profile.h"

namespace scipd::daemon {

[[nodiscard]] protocol::DeviceProfile powered_profile(const SensorConfig& config, const Unit& unit);

}  // namespace scipd::daemon
