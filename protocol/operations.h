// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a request does to the device that all sessions share. Streams and single shots belong to a
// session and are not done here.
#pragma once

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/request.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// Carries out a request that its state allows and that is as long as it should be. The status is
/// the reply's; with any but 00 (01 of a first RB) nothing has changed.
[[nodiscard]] Status operate(DeviceState& device, const Request& request,
                             const DeviceProfile& profile, Uptime now);

}  // namespace scipd::protocol
