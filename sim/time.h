// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>

namespace scipd::sim {

/// Time of the simulated world since its epoch: the start of the daemon on the wall clock, the
/// stamps of the pose stream in lockstep. Nothing in sim/ reads a clock; whoever calls hands the
/// time in.
using Time = std::chrono::nanoseconds;

}  // namespace scipd::sim
