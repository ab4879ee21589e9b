// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The codes that now and then stand where another mostly does, by their shares. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/device_profile.h"
#include "sim/sensor/reading.h"

namespace scipd::daemon {

/// `distance` has what the readings mostly mean on the wire.
void put_rare_codes(std::span<const sim::Reading> readings, const protocol::DeviceProfile& profile,
                    std::span<std::uint32_t> distance);

}  // namespace scipd::daemon
