// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whole replies in which the device tells what it is and how it is: VV, PP, II, %ST, TM1.
#pragma once

#include <string>
#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/request.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

[[nodiscard]] std::string version_report(std::string_view echo, const DeviceProfile& profile);
[[nodiscard]] std::string parameter_report(std::string_view echo, const DeviceProfile& profile);
/// Seven lines, with the time `shown`. A device that has failed sends two lines only.
[[nodiscard]] std::string state_report(std::string_view echo, const DeviceProfile& profile,
                                       const DeviceState& device, Uptime shown);
/// The state as a number of three digits.
[[nodiscard]] std::string state_number_report(std::string_view echo, const DeviceState& device,
                                              Uptime now);
/// TM1, with the time `shown`.
[[nodiscard]] std::string time_report(const Request& request, const DeviceState& device,
                                      Uptime shown);

}  // namespace scipd::protocol
