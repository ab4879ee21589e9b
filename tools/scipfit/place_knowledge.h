// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a PlaceFit tells and what it does not, with intervals. Values; one thread.
#pragma once

#include <vector>

#include "tools/scipfit/block_sums.h"
#include "tools/scipfit/place_fit.h"

namespace scipd::tools {

struct PlaceAt {
    Interval x_mm, y_mm, yaw_rad;
};

/// What is known of a fit: for each parameter, with its 95 % interval.
struct PlaceKnowledge {
    std::vector<bool> knots;
    bool but_for_slope = false;  ///< the curve is known, but for a slope over the range
    bool is_line = false;        ///< nothing is left of it beside a line
    bool offset = false;
    bool scale = false;
    std::vector<bool> places;
    std::vector<Interval> bias_mm;  ///< at the knots
    std::vector<Interval> bent_mm;  ///< at the knots: the line at the range 0 and what is left
    Interval offset_mm;             ///< at the range 0, of the line through the curve
    Interval scale_mm_per_m;        ///< the slope of that line
    std::vector<PlaceAt> at;
};

[[nodiscard]] PlaceKnowledge knowledge_of(const std::vector<Sight>& sights, const PlaceFit& fit);

}  // namespace scipd::tools
