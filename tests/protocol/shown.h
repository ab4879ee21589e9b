// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Bytes, instants and models as a person can read them: in the words of faults and the names of
// tests.
#pragma once

#include <string>
#include <string_view>

#include "protocol/device_profile.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// Between double quotes, as a string literal of C++ would have them.
std::string shown(std::string_view bytes);
std::string milliseconds(Uptime time);
/// A name of letters, digits and underscores, as GoogleTest wants it.
std::string test_name(const DeviceProfile& profile);

}  // namespace scipd::protocol
