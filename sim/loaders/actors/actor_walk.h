// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How an actor moves from waypoint to waypoint, as in Gazebo. Any thread; nothing shared.
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
    double tension = 0.0;             ///< 0: a Catmull-Rom spline, 1: straight lines
    std::vector<Waypoint> waypoints;  ///< at least one, in order, 1 ms or more apart
};

/// Runs the trajectories one after the other, each from its own time 0. If the first waypoint of a
/// trajectory has a later time, the actor waits at it. Before each lap the actor waits for `delay`
/// at the first waypoint of all. Null if the script takes more than 4e9 s, which a Time cannot
/// hold.
///
/// Gazebo Classic does the same (gazebo/physics/Actor.cc, LoadScript and Update). Gazebo Sim waits
/// only once, and starts each trajectory at its first waypoint, whatever the time of that waypoint
/// (src/rendering/SceneManager.cc, ActorTrajectoryAt). Positions follow ignition::math::Spline over
/// the share of time between two waypoints within 0.1 mm, as in both Gazebos (common/Animation.cc).
/// The actor turns evenly, by the shorter way. gz-math's RotationSpline does the same where the
/// axis hardly changes, as with people; its older versions overshoot, and spin where a yaw passes
/// 180 degrees.
SharedScript walk_of(const std::vector<ActorTrajectory>& trajectories, Time delay, bool loops);

}  // namespace scipd::sim
