// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What intensities do: how they vary, and how bright walls are by range. What a wall reflects and
// what the receiver makes of it are known as their product alone. Values; one thread.
#pragma once

#include <string>
#include <vector>

#include "tools/scipfit/noise_fit.h"

namespace scipd::tools {

struct LightNoise {
    double intensity = 0.0;  ///< the middle of the beams
    Interval share;          ///< its deviation, as a share of it
    std::size_t beams = 0;
};

struct LightAt {
    double range_mm = 0.0;
    double intensity = 0.0;  ///< the middle of the walls there, as if they were met head-on
    std::size_t beams = 0;
};

struct LightFit {
    std::vector<LightNoise> noise;                       ///< by growing intensity
    std::vector<LightAt> by_range;                       ///< by growing range
    std::string of_what = "as if all walls were white";  ///< by_range
};

/// Empty where the recording has no intensities.
[[nodiscard]] LightFit fit_light(const Standing& standing);

}  // namespace scipd::tools
