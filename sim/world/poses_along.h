// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where something on a moving thing is at a thousand times of a sweep. What the poses of a stretch
// share is worked out once, which takes a fifth of the time that PoseTrack::at() takes for each.
// Pure.
#pragma once

#include <span>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"
#include "sim/world/pose_track.h"

namespace scipd::sim {

/// track.at(time) * thing_from_mount for each of the times, none of which is earlier than the one
/// before. The thing turns along the arc; at() may cut it short, by a microradian at most.
[[nodiscard]] std::vector<Pose> poses_along(const PoseTrack& track, const Pose& thing_from_mount,
                                            std::span<const Time> times);

}  // namespace scipd::sim
