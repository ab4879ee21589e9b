// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a robot's poses come from and what holds where there are none: `poses: SOURCE`, or a map
// with `from: SOURCE` and more. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "daemon/config/claims.h"
#include "daemon/config/config.h"
#include "daemon/config/section.h"

namespace scipd::daemon {

/// Fills what `field`, the value of the robot's key `poses`, says of it and of its sensors.
void read_poses(const Field& field, RobotConfig& robot, const std::filesystem::path& base,
                Claims& claims, Faults& faults);

}  // namespace scipd::daemon
