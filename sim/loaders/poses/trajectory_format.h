// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::sim {

/// How the file of a trajectory is written.
enum class TrajectoryFormat {
    guess,
    tum,    ///< `t tx ty tz qx qy qz qw` a line, in seconds
    euroc,  ///< its state_groundtruth_estimate0/data.csv, in nanoseconds
    kitti,  ///< twelve numbers a line (kitti_line.h), with stamps of a times.txt or at 10 Hz
    csv,    ///< a header names the columns (column_names.cpp)
};

}  // namespace scipd::sim
