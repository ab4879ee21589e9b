// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// DB: a scanner that pretends to be in trouble, so that a host can rehearse what it does then. Some
// rehearsals begin at once, some in the midst of a long stream.
#pragma once

#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/status.h"
#include "protocol/subscription.h"

namespace scipd::protocol {

/// Begins the rehearsal that the two digits name, or ends it with 10. 01 no such rehearsal, 02 it
/// is under way, 03 none is, 04 not on this model, 05 the device really is in trouble, 0C firmware
/// older than the command.
[[nodiscard]] Status rehearse(DeviceState& device, std::string_view digits,
                              const DeviceProfile& profile);

/// To be called for each scan of a stream before it is sent: the trouble may begin or end with it.
/// Rehearsals 03 to 05 act in streams of more than 20 scans only.
void rehearse_in_stream(DeviceState& device, const Subscription& stream);

}  // namespace scipd::protocol
