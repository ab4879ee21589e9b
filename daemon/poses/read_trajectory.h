// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the trajectory that a robot is to play. A large file takes seconds, for which nothing that
// runs must wait. Any thread; nothing shared.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "sim/loaders/poses/trajectory.h"

namespace scipd::daemon {

/// Several robots may play the same ones.
using PlayedPoses = std::shared_ptr<const std::vector<sim::TimedPose>>;

struct ReadTrajectory {
    PlayedPoses poses;
    std::vector<std::string> warnings;
};

/// Throws sim::LoadError where it cannot be read.
ReadTrajectory read_trajectory(const PoseSource& source);

/// Throws sim::LoadError where nobody can play the poses at the speed of the source.
void check_speed(const PoseSource& source, const std::vector<sim::TimedPose>& poses);

}  // namespace scipd::daemon
