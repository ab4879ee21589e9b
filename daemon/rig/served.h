// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What systemd sees of a simulation that runs. On the I/O thread.
#pragma once

#include "daemon/service/service.h"

namespace scipd::daemon {

struct Simulation;

/// Its status is such as "2 sensors in room.sdf: robot/front on 127.0.0.1:10940 and
/// /run/scipd/robot-front, ..". `simulation` must outlive it.
[[nodiscard]] Served served(Simulation& simulation);

}  // namespace scipd::daemon
