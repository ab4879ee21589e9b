// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>

namespace scipd::protocol {

/// Time since the device was powered up, by its own crystal, which mirror, ticks and stamps run on.
/// Nothing in protocol/ reads a clock: whoever calls hands this in.
using Uptime = std::chrono::nanoseconds;

}  // namespace scipd::protocol
