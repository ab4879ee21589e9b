// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>

namespace scipd::protocol {

/// Time since power-up by the device's own crystal. Mirror, ticks and stamps run on it. Nothing in
/// protocol/ reads a clock: the caller hands the time in.
using Uptime = std::chrono::nanoseconds;

}  // namespace scipd::protocol
