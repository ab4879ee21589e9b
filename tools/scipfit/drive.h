// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording of a scanner that was carried through a building, and that tells where it was.
// Values; one thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/recording/values/recorded_scan.h"
#include "tools/scipfit/wall.h"

namespace scipd::tools {

using sim::LaserPose;

/// `pose`, which is told in the frame of `outer`, in that frame's own.
[[nodiscard]] LaserPose compose(const LaserPose& outer, const LaserPose& pose);
/// `pose` as seen from `from`; both are told in one frame.
[[nodiscard]] LaserPose relative(const LaserPose& from, const LaserPose& pose);
/// Where a point is that the laser sees.
[[nodiscard]] Point placed(const LaserPose& pose, const Point& seen);

struct DriveScan {
    LaserPose pose;           ///< as recorded; that of the first scan is the origin
    std::vector<Point> seen;  ///< where its beams ended, from the laser: x is forward, y left
};

struct Drive {
    std::vector<DriveScan> scans;
    std::size_t without_place = 0;  ///< scans whose pose is not recorded: they are left out
};

/// Reads the scans of `stream`, or of the first that has scans. Throws WrongInput where the file
/// cannot be read, where no pose is recorded, and where nobody says where the beams look.
[[nodiscard]] Drive read_drive(const std::filesystem::path& file, const std::string& stream);

}  // namespace scipd::tools
