// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a ROS map does not say of its walls: `map: {z: [BOTTOM, TOP], material: NAME, unknown: ..}`.
// Any thread; nothing shared.
#pragma once

#include "daemon/config/section.h"
#include "sim/loaders/map/ros_map.h"

namespace scipd::daemon {

/// `field` is the value of the root's key `map`.
sim::MapOptions read_map(const Field& field, Faults& faults);

}  // namespace scipd::daemon
