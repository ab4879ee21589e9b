// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a scanner was on a drive: odometry slips, so each scan is laid over what those before it
// have seen. It closes no loops: for long drives there are programs that make maps. One thread.
#pragma once

#include <vector>

#include "tools/scipfit/drive.h"
#include "tools/scipfit/drive_grid.h"

namespace scipd::tools {

/// Where each scan of a drive was, and what all of them saw from there.
struct LaidDrive {
    DriveGrid grid;
    std::vector<LaserPose> places;
};

[[nodiscard]] LaidDrive laid_as_recorded(const std::vector<DriveScan>& drive, double cell_m);
[[nodiscard]] LaidDrive laid_over_itself(const std::vector<DriveScan>& drive, double cell_m);

/// The place near `start` where the ends of a scan lie best on the faces of a grid; `start` where
/// few of them do.
[[nodiscard]] LaserPose laid_over(const DriveGrid& grid, const DriveScan& scan,
                                  const LaserPose& start);

}  // namespace scipd::tools
