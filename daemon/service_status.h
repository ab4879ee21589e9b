// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scipd that runs tells people about itself in a line. On the I/O thread.
#pragma once

#include <string>

namespace scipd::daemon {

struct Simulation;

/// "2 sensors in room.sdf: robot/front on 127.0.0.1:10940 and /run/scipd/robot-front, .."
[[nodiscard]] std::string status_line(const Simulation& simulation);

}  // namespace scipd::daemon
