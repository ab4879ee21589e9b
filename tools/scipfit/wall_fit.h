// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The walls that a standing scanner sees, as planes that stand upright. The scanner is the origin,
// x is where it looks. Values; one thread.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scipfit/standing.h"

namespace scipd::tools {

struct Point {
    double x_m = 0.0;
    double y_m = 0.0;
};

struct Wall {
    double normal_rad = 0.0;    ///< the direction in which the wall is nearest...
    double distance_m = 0.0;    ///< ...and how far that is
    Point begin, end;           ///< counter-clockwise
    std::size_t first = 0;      ///< the beams that see it: first...
    std::size_t last = 0;       ///< ...and last
    double deviation_mm = 0.0;  ///< of the middles of its beams

    /// What a beam in this direction reads of the endless wall.
    [[nodiscard]] double range_m(double angle_rad) const;
};

/// By split and merge, each refined by least squares that a few wrong beams do not move. Corners
/// are where walls meet.
[[nodiscard]] std::vector<Wall> walls_of(const Readings& readings, const Station& station);

/// How well the walls explain what the scanner saw.
struct RoomCheck {
    std::size_t beams = 0;      ///< that see something still
    std::size_t explained = 0;  ///< whose middle lies within 30 mm of the wall that it meets first
    double rms_mm = 0.0;        ///< of those
    double worst_of_95_mm = 0.0;  ///< 95 % of those are nearer
};

[[nodiscard]] RoomCheck check_room(const std::vector<Wall>& walls, const Readings& readings,
                                   const Station& station);

}  // namespace scipd::tools
