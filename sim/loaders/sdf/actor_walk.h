// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The way of an actor from waypoint to waypoint, as Gazebo lets it go. Any thread; nothing shared.
#pragma once

#include <vector>

#include "sim/world/script.h"

namespace scipd::sim {

struct Waypoint {
    Time time{};  ///< since its trajectory began
    Pose pose;
};

struct ActorTrajectory {
    int id = 0;
    double tension = 0.0;             ///< 0: a Catmull-Rom spline, 1: straight from one to the next
    std::vector<Waypoint> waypoints;  ///< one at least, by time, a millisecond or more apart
};

/// One trajectory after the other, each from its own time 0: whose first waypoint comes later waits
/// at it. `delay` is waited at the first before each lap. Null where it takes longer than a Time
/// can tell.
///
/// Gazebo Classic does so (gazebo/physics/Actor.cc, LoadScript and Update). Gazebo Sim waits once,
/// and begins each trajectory with its first waypoint whatever its time
/// (src/rendering/SceneManager.cc, ActorTrajectoryAt). Places are those of ignition::math::Spline
/// over the share of time between two waypoints, as both have it (common/Animation.cc), within
/// 0.1 mm. Turns are even, by the shorter way: so has it gz-math's RotationSpline where one axis
/// hardly turns, as of people. Older versions overshoot, and whirl where a yaw passes 180 degrees.
SharedScript walk_of(const std::vector<ActorTrajectory>& trajectories, Time delay, bool loops);

}  // namespace scipd::sim
