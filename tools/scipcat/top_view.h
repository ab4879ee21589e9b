// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan seen from above, in the scanner's frame: x forward, y left, metres, the scanner at the
// origin. Not a picture yet: the plots put it on paper or into the terminal. A value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::tools {

struct ViewPoint {
    double x_m = 0.0;
    double y_m = 0.0;
    double range_m = 0.0;
    std::uint32_t intensity = 0;
    int step = 0;           ///< the first of its group
    int echo = 0;           ///< of its beam, near to far, the first is 0
    bool adjacent = false;  ///< the direction just before has a point as well
    bool joined = false;    ///< and the two points seem to be on one surface
    // If the truth is known:
    std::string material;           ///< empty: of nothing that has one
    std::optional<double> error_m;  ///< how much too far
};

/// The rectangle of everything to be shown; never empty.
struct Bounds {
    double min_x_m = 0.0;
    double max_x_m = 0.0;
    double min_y_m = 0.0;
    double max_y_m = 0.0;

    void include(double x_m, double y_m);
    void widen(double margin_m);
    [[nodiscard]] double height_m() const { return max_x_m - min_x_m; }
    [[nodiscard]] double width_m() const { return max_y_m - min_y_m; }
};

struct TopView {
    std::vector<ViewPoint> points;   ///< one for each direction with a return
    std::vector<ViewPoint> further;  ///< the second and third echoes, if they were asked for
    std::size_t directions = 0;      ///< all, with and without a return
    double first_angle_rad = 0.0;    ///< the field of view begins here
    double last_angle_rad = 0.0;
    bool has_intensity = false;
    Bounds bounds;                       ///< the points, the scanner and a margin
    std::vector<std::string> materials;  ///< names that the world has, in its order, if it is known
};

/// A value that is no distance (sim::reading_of) leaves no point. The scan knows
/// where it looks.
[[nodiscard]] TopView make_top_view(const sim::RecordedScan& scan,
                                    const sim::ScannerIdentity& identity);

/// The step, 1, 2 or 5 times a power of ten, that divides `length_m` into at most `most` parts.
[[nodiscard]] double round_step_m(double length_m, double most);

}  // namespace scipd::tools
