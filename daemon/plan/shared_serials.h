// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user should know who gives one serial number to several scanners. Any thread; nothing
// shared.
#pragma once

#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/plan/known_sensors.h"

namespace scipd::daemon {

/// A sentence for each number that several scanners have of which one is not running: they are the
/// same unit, and read too far by the same. Where each says its bias itself, that is nobody's
/// mistake.
[[nodiscard]] std::vector<std::string> serial_notices(const Config& config,
                                                      const KnownSensors& running);

}  // namespace scipd::daemon
