// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads the trajectories that robots of a configuration play. Touches nothing that runs: any thread
// may do it.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/poses/read_trajectory.h"

namespace scipd::daemon {

/// Which robot plays what.
using PlayedSources = std::map<std::string, PoseSource>;

struct LoadedTrajectories {
    std::map<std::string, PlayedPoses> poses;  ///< by robot
    std::vector<std::string> warnings;
};

/// But for those that are played already. Where the configuration is strict, warnings are faults.
/// Throws sim::LoadError with every fault, or soon after `stop`.
LoadedTrajectories load_trajectories(const Config& config, const PlayedSources& played = {},
                                     const std::stop_token& stop = {});

}  // namespace scipd::daemon
