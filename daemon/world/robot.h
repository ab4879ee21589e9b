// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A robot of the world, and how it has moved. A value; one thread.
#pragma once

#include <string>

#include "sim/world/pose.h"
#include "sim/world/pose_track.h"

namespace scipd::daemon {

/// A robot as it is configured.
struct RobotStart {
    sim::Pose world_from_robot;  ///< where it starts
    sim::PosePolicy policy;
    std::string body;  ///< the movable model that moves with it; empty: it has none

    bool operator==(const RobotStart&) const = default;
};

struct Robot {
    RobotStart start;
    sim::PoseTrack track;
};

}  // namespace scipd::daemon
