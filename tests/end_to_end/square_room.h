// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Ranges in scenes/square_room.sdf in closed form, seen from above: what a horizontal beam below 1
// m hits. It shares no code with the program under test.
#pragma once

#include <optional>

namespace scipd::tests {

struct Planar {
    double x_m = 0.0;
    double y_m = 0.0;
    double yaw_rad = 0.0;
};

/// From a point in the room, `bearing_rad` counter-clockwise from its x axis.
double range_in_square_room(const Planar& from, double bearing_rad);

/// The range, or nothing if the beam grazes a surface or an edge, because then its range is not
/// known to the millimetre.
std::optional<double> certain_range_in_square_room(const Planar& from, double bearing_rad);

}  // namespace scipd::tests
