// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/read_trajectory.h"

#include <chrono>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/poses/trajectory_file.h"

namespace scipd::daemon {
namespace {

// Laps that take no time would never reach the next moment, and a lap that does not fit into a Time
// would go backwards.
constexpr double shortest_lap_s = 1e-3;
constexpr double longest_lap_s = 4e9;

}  // namespace

ReadTrajectory read_trajectory(const PoseSource& source) {
    sim::Trajectory loaded = sim::load_trajectory(source.file, source.format, source.times);
    return {std::make_shared<const std::vector<sim::TimedPose>>(std::move(loaded.poses)),
            std::move(loaded.warnings)};
}

void check_speed(const PoseSource& source, const std::vector<sim::TimedPose>& poses) {
    const std::chrono::duration<double> lap = sim::lap_time(poses);
    const double lap_s = lap.count() / source.speed;
    const bool too_short = source.loop && poses.size() > 1 && lap_s < shortest_lap_s;
    if (!too_short && lap_s <= longest_lap_s) return;
    throw sim::LoadError(
        {source.file.string() + ": at this speed it takes " +
         (too_short ? "less than a millisecond, which is no loop" : "more than 4e9 s")});
}

}  // namespace scipd::daemon
