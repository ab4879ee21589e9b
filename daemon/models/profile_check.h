// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether the figures of a profile go together, for those that a user has put together: what could
// not be said on the wire, and what no device would say of itself. Any thread; nothing shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/device_profile.h"

namespace scipd::daemon {

/// What SS can say: six digits; slower lines were never made.
inline constexpr int slowest_bit_rate = 300;
inline constexpr int fastest_bit_rate = 999'999;

struct ProfileFault {
    std::string_view member;  ///< of DeviceProfile: "amax"
    std::string sentence;     ///< what to do
};

/// All at once, in the order of the members; empty: it is sound.
[[nodiscard]] std::vector<ProfileFault> faults_of(const protocol::DeviceProfile& profile);

}  // namespace scipd::daemon
