// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Settings that a ROS map does not have. A value.
#pragma once

#include <string>

namespace scipd::sim {

/// What unknown cells become.
enum class UnknownCells {
    free,
    wall,
    unknown,  ///< as high as walls, of a material named unknown
};

struct MapOptions {
    double bottom_m = 0.0;  ///< z of the walls in W; below top_m
    double top_m = 2.0;
    std::string material = "wall";
    UnknownCells unknown = UnknownCells::free;

    bool operator==(const MapOptions&) const = default;
};

}  // namespace scipd::sim
