// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A UDP port for a scipd that is to be started. Any thread.
#pragma once

#include <cstdint>

namespace scipd::tools {

/// One of 127.0.0.1 that nobody has now.
[[nodiscard]] std::uint16_t free_udp_port();

}  // namespace scipd::tools
