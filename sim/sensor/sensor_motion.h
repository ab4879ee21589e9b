// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How far a sensor gets away from its middle pose while it sweeps. A value; any thread.
#pragma once

#include <span>

#include "sim/world/pose.h"

namespace scipd::sim {

struct SensorMotion {
    Pose middle;              ///< of the sensor in the world, halfway through the sweep
    double moved_m = 0.0;     ///< it is nowhere farther from there
    double turned_rad = 0.0;  ///< nor turned farther
};

/// `world_from_sensor`: one pose, or one for each beam; not empty.
[[nodiscard]] SensorMotion motion_of(std::span<const Pose> world_from_sensor);

}  // namespace scipd::sim
