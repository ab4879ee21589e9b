// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a standing scanner looks, and at what: places and faces, seen from above. Values; no thread
// rule.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scipfit/noise_fit.h"

namespace scipd::tools {

/// Where a scanner stands upright in a world.
struct FlatPose {
    double x_mm = 0.0;
    double y_mm = 0.0;
    double yaw_rad = 0.0;
    double z_mm = 0.0;
};

/// The points of an upright face: cos(normal) x + sin(normal) y = distance. The normal points to
/// behind it.
struct FaceLine {
    double normal_rad = 0.0;
    double distance_mm = 0.0;

    /// How far away it is from there, in this direction of the world.
    [[nodiscard]] double range_mm(const FlatPose& place, double direction_rad) const;
};

/// One beam at one station.
struct Sight {
    std::size_t station = 0;  ///< index into Standing::stations
    std::size_t beam = 0;
    double angle_rad = 0.0;     ///< from where the scanner looks
    double range_mm = 0.0;      ///< what it reads on average
    double deviation_mm = 0.0;  ///< of that average
    double intensity = 0.0;
    std::size_t face = 0;     ///< index into Sights::faces
    std::size_t surface = 0;  ///< what has one colour: an object of a world, or a wall
};

struct Sights {
    std::vector<FaceLine> faces;
    std::vector<Sight> list;
};

/// The beams of a station that meet a smooth face at less than 65 degrees, before it is known which
/// face that is.
[[nodiscard]] std::vector<Sight> sights_of(const Standing& standing, std::size_t station);

}  // namespace scipd::tools
