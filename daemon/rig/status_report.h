// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a running rig is doing. On the I/O thread.
#pragma once

#include "daemon/api/api.h"

namespace scipd::daemon {

struct Simulation;

[[nodiscard]] RigStatus status_of(const Simulation& simulation);

}  // namespace scipd::daemon
