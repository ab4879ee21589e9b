// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans whose every property is known, since they are drawn here: a room of 6 m by 4 m with a box
// in it, a window that gives codes, noise that neighbours share, and a clock.
#pragma once

#include <cstdint>

#include "tools/scipcat/compare/compare_series.h"

namespace scipd::tests {

struct MadeScans {
    std::uint32_t seed = 1;
    int scans = 60;
    int steps = 1081;
    double sigma_mm = 5;
    double shared = 0.5;  ///< the weight of either neighbour in the noise of a beam
    double box_nearer_m = 0;
    double too_far_mm = 0;  ///< at 2 m; at others in proportion to the root of the range
    double bright = 1;
    int edge_code = 7;  ///< in a third of the scans, to both sides of the window
    int window_code = 0;
    // Where the scanner stands.
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;
    // Its clock, which is told in whole milliseconds, and how scans reach the host.
    double period_s = 0.02505;
    double ppm = 0;
    double jitter_ms = 0.3;
    bool angles = true;
};

/// What the room is at an angle from there, without any error; 0 in the window.
[[nodiscard]] double made_range_m(const MadeScans& made, double angle_rad);

[[nodiscard]] tools::comparing::Taken make_scans(const MadeScans& made);

}  // namespace scipd::tests
