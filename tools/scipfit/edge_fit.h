// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What stands still besides noise: beams that an edge mixes, and how distances drift. Values; one
// thread.
#pragma once

#include <optional>

#include "tools/scipfit/noise_fit.h"

namespace scipd::tools {

struct MixedBeams {
    Interval beams;  ///< of one edge, that lie between its two faces
    std::size_t edges = 0;
    double smallest_mm = 0.0;  ///< and largest distance between the faces
    double largest_mm = 0.0;
};

/// Nothing where there are too few edges.
[[nodiscard]] std::optional<MixedBeams> mixed_beams(const Standing& standing);

struct Drift {
    Interval mm;  ///< from the begin of the longest station to its end, of all beams together
    double seconds = 0.0;  ///< 0: not known
    std::size_t scans = 0;
};

/// Nothing where nothing stands still.
[[nodiscard]] std::optional<Drift> relative_drift(const Standing& standing);

}  // namespace scipd::tools
