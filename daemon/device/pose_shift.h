// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How the poses that a sensor is cast from differ from those of its robot, by a fault. A value; any
// thread.
#pragma once

#include <optional>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::daemon {

struct PoseShift {
    std::optional<sim::Pose> stopped;  ///< the robot stays at this pose
    sim::Time late{};                  ///< the robot is where it was so long ago
    sim::Pose jump;  ///< the robot is displaced by this, and turned about itself, in W

    bool operator==(const PoseShift&) const = default;
};

}  // namespace scipd::daemon
