// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/powered_profile.h"

#include <algorithm>
#include <string>

#include "protocol/ideal.h"

namespace scipd::daemon {
namespace {

// The rate of the serial line can be set for good by the user, as II says.
void power_up_at(int bit_rate, protocol::DeviceProfile& profile) {
    const auto place = std::ranges::find(profile.bit_rates, bit_rate);
    if (place == profile.bit_rates.end()) return;
    std::rotate(profile.bit_rates.begin(), place, place + 1);
    profile.bit_rate = std::to_string(bit_rate) + "[bps]<-Default setting by user";
}

}  // namespace

protocol::DeviceProfile powered_profile(const SensorConfig& config, const Unit& unit) {
    protocol::DeviceProfile profile = config.model.profile;
    profile.serial = unit.serial;
    if (config.timing == Timing::ideal) profile = protocol::ideal(profile);
    profile.scan_period = unit.turn(profile.scan_period);
    if (config.link.baud) power_up_at(*config.link.baud, profile);
    return profile;
}

}  // namespace scipd::daemon
