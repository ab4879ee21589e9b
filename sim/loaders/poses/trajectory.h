// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A trajectory as values, however its file is written: poses, each with its time. Who reads the
// file is in trajectory_file.h. Any thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// How the file of a trajectory is written.
enum class TrajectoryFormat {
    guess,
    tum,    ///< `t tx ty tz qx qy qz qw` a line, in seconds
    euroc,  ///< its state_groundtruth_estimate0/data.csv, in nanoseconds
    kitti,  ///< twelve numbers a line, with stamps of a times.txt or at 10 Hz
    csv,    ///< a header names the columns (column_names.cpp)
};

struct TimedPose {
    Time time{};  ///< on the sender's clock
    Pose pose;
};

struct Trajectory {
    std::vector<TimedPose> poses;  ///< stamps strictly growing, within 4.5e9 s
    std::vector<std::string> warnings;
};

/// How long one lap of a loop takes: from the first pose until the next lap is at the first pose
/// again. The way back from the last pose takes as long as the last step. Zero where there is only
/// one pose, which makes no loop.
Time lap_time(const std::vector<TimedPose>& poses);

}  // namespace scipd::sim
