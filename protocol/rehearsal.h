// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// DB makes a scanner pretend to be in trouble, so that a host can rehearse what it does then. Some
// rehearsals begin at once, others in the midst of a long stream.
#pragma once

#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/status.h"
#include "protocol/subscription.h"

namespace scipd::protocol {

/// Begins the rehearsal that the two digits name; 10 ends the one that is under way. The status is
/// one of status::rehearsal, or 0C where the firmware is older than the command.
[[nodiscard]] Status rehearse(DeviceState& device, std::string_view digits,
                              const DeviceProfile& profile);

/// To be called before each scan of a stream is sent: the trouble may begin or end with that scan.
/// Rehearsals 03 to 05 act in streams of more than 20 scans only.
void rehearse_in_stream(DeviceState& device, const Subscription& stream);

}  // namespace scipd::protocol
