// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Checks that the figures of a profile fit together. It is for profiles that users write: it finds
// figures that SCIP cannot express, and figures that no real device would report. Any thread;
// nothing shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/device_profile.h"

namespace scipd::daemon {

/// SS takes six digits, but no slower line was ever made.
inline constexpr int slowest_bit_rate = 300;
inline constexpr int fastest_bit_rate = 999'999;

struct ProfileFault {
    std::string_view member;  ///< of DeviceProfile: "amax"
    std::string sentence;     ///< what to do
};

/// All faults, in the order of the members; empty if the profile is sound.
[[nodiscard]] std::vector<ProfileFault> faults_of(const protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
