// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one beam of a standing scanner saw. A value; no thread rule.
#pragma once

#include <cstddef>

namespace scipd::tools {

/// A beam over the time of one station.
struct Beam {
    std::size_t count = 0;      ///< of its distances
    double mean_mm = 0.0;       ///< in the middle of the station's time
    double trend_mm = 0.0;      ///< more, from scan to scan
    double variance_mm2 = 0.0;  ///< around the trend
    double scatter_mm2 = 0.0;   ///< half the mean square from scan to scan: the same without drift
    double intensity = 0.0;     ///< mean
    double slope_mm = 0.0;      ///< how much farther the next beam is, on its face
    bool still = false;         ///< it sees one thing that does not move
    bool end_before = true;     ///< a face ends between the beam before and this one
    bool inside = false;        ///< still, and two beams on either side see the same face
};

}  // namespace scipd::tools
