// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Devices that keep nobody waiting: for tests that are not about time, and for a world whose time
// stands still between steps.
#pragma once

#include "protocol/device_profile.h"

namespace scipd::protocol {

/// The device without ticks and delays: replies and scans leave as soon as they can.
[[nodiscard]] DeviceProfile answering_at_once(DeviceProfile profile);

/// The device as its data sheet has it: turns take their nominal time, and nothing waits, boots
/// or wakes.
[[nodiscard]] DeviceProfile ideal(DeviceProfile profile);

}  // namespace scipd::protocol
