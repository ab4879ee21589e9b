// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a client may set on some models: the rate of the serial line (SS), the speed of the motor
// (CR) and the sensitivity (HS). Nothing here knows laser and modes.
#pragma once

#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/status.h"

namespace scipd::protocol {

struct Settings {
    int bit_rate = 0;        ///< of the serial line; 0: as at power-up
    int motor_level = 0;     ///< 0: as at power-up, 1 to 10: slower by so many hundredths
    bool sensitive = false;  ///< high-sensitivity mode

    bool operator==(const Settings&) const = default;
};

// These take the digits of a request and return the status of its reply. Where it is another than
// 00, nothing has changed.

/// A status of status::setting.
[[nodiscard]] Status set_bit_rate(Settings& settings, std::string_view digits,
                                  const DeviceProfile& profile);
/// A status of status::setting.
[[nodiscard]] Status set_motor_level(Settings& settings, std::string_view digits,
                                     const DeviceProfile& profile);
/// A status of status::sensitivity, or 0C where the firmware is older than the command.
[[nodiscard]] Status set_sensitivity(Settings& settings, std::string_view digits,
                                     const DeviceProfile& profile);

/// Network address, mask and gateway of $IP, twelve digits each; 01 where they are no octets. A
/// real scanner takes them from its next power-up on. Here they are not kept, as the configuration
/// says where a device listens.
[[nodiscard]] Status check_addresses(std::string_view digits);

/// The rate of the line, whether or not somebody has set one; 0: no serial line.
[[nodiscard]] int bit_rate_of(const Settings& settings, const DeviceProfile& profile);

}  // namespace scipd::protocol
