// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/poses/trajectory.h"

namespace scipd::sim {

Time lap_time(const std::vector<TimedPose>& poses) {
    if (poses.size() < 2) return {};
    const Time last_step = poses.back().time - poses[poses.size() - 2].time;
    return poses.back().time - poses.front().time + last_step;
}

}  // namespace scipd::sim
