// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a client may set on some models: the rate of the serial line (SS), the speed of the motor
// (CR) and the sensitivity (HS). Each request is a value or a status; nothing here knows laser and
// modes.
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

// Digits of a request into the settings. The status is the reply's; with any but 00 nothing has
// changed.

/// 01 no number, 02 no rate of this model, 03 the present one, 04 a model without a serial line.
[[nodiscard]] Status set_bit_rate(Settings& settings, std::string_view digits,
                                  const DeviceProfile& profile);
/// 01 no number, 02 no such level, 03 the present one, 04 a model with one speed only.
[[nodiscard]] Status set_motor_level(Settings& settings, std::string_view digits,
                                     const DeviceProfile& profile);
/// 01 neither 0 nor 1, 02 as it is, 03 a model that never had it, 0C firmware older than it.
[[nodiscard]] Status set_sensitivity(Settings& settings, std::string_view digits,
                                     const DeviceProfile& profile);

/// Network address, mask and gateway of $IP, twelve digits each: 01 no octets. They hold from the
/// next power-up on, which is not in the device's hands, so that nothing keeps them.
[[nodiscard]] Status check_addresses(std::string_view digits);

/// The rate of the line, also where nobody has set one; 0: no serial line.
[[nodiscard]] int bit_rate_of(const Settings& settings, const DeviceProfile& profile);

}  // namespace scipd::protocol
