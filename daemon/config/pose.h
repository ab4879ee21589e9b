// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a robot or a mount is: {xyz: [..], rpy: [..]}, each zeros where it is left out. Any thread;
// nothing shared.
#pragma once

#include <string_view>

#include "daemon/config/section.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

/// The pose under this key; the origin where there is none.
sim::Pose read_pose(const Section& parent, std::string_view key, Faults& faults);

}  // namespace scipd::daemon
