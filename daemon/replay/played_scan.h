// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan of a recording as a sensor's readings: what faults act on. Values; any thread.
#pragma once

#include <cstdint>

#include "daemon/replay/tape.h"
#include "protocol/device_profile.h"
#include "sim/sensor/scan.h"

namespace scipd::daemon {

/// Its rays have met nothing: there was no world.
[[nodiscard]] sim::Scan played_scan(const TapedScan& taped, const protocol::DeviceProfile& profile,
                                    std::int64_t revolution, sim::Time start,
                                    const sim::Pose& world_from_sensor);

}  // namespace scipd::daemon
