// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a file of a world says of a lidar that it has: an offer, which no scanner need be like.
// Plain values.
#pragma once

namespace scipd::sim {

struct Lidar {
    int samples = 0;  ///< a row
    int rows = 1;
    double min_angle_rad = 0.0;
    double max_angle_rad = 0.0;
    double min_range_m = 0.0;
    double max_range_m = 0.0;  ///< infinity: as far as can be
    double rate_hz = 0.0;      ///< 0: as often as can be

    bool operator==(const Lidar&) const = default;
};

}  // namespace scipd::sim
