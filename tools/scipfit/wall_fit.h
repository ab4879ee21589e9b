// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The walls that a standing scanner sees, as planes that stand upright. The scanner is the origin,
// x is where it looks. Values; one thread.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scipfit/standing.h"
#include "tools/scipfit/wall.h"

namespace scipd::tools {

/// By split and merge, each refined by least squares that a few wrong beams do not move. Corners
/// are where walls meet.
[[nodiscard]] std::vector<Wall> walls_of(const ScanTable& readings, const Station& station);

/// How well the walls explain what the scanner saw.
struct RoomCheck {
    std::size_t beams = 0;      ///< that see something still
    std::size_t explained = 0;  ///< whose middle lies within 30 mm of the wall that it meets first
    double rms_mm = 0.0;        ///< of those
    double worst_of_95_mm = 0.0;  ///< 95 % of those are nearer
};

[[nodiscard]] RoomCheck check_room(const std::vector<Wall>& walls, const ScanTable& readings,
                                   const Station& station);

}  // namespace scipd::tools
