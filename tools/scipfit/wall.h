// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A wall that a standing scanner sees, as a plane that stands upright. The scanner is the origin, x
// is where it looks. A value; no thread rule.
#pragma once

#include <cmath>
#include <cstddef>

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
    [[nodiscard]] double range_m(double angle_rad) const {
        return distance_m / std::cos(angle_rad - normal_rad);
    }
};

}  // namespace scipd::tools
