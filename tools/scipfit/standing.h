// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a recording stands still, and which beams see something still that is no edge: what noise
// can be learned from. Values; one thread.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/analysis/scan_table.h"

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

/// Says of each beam whether a face ends before it and whether it is inside one, and how that
/// slopes. Their middles and their stillness are known.
void find_faces(double beam_rad, std::vector<Beam>& beams);

/// A time in which the scanner stood still.
struct Station {
    std::size_t first = 0;  ///< scan
    std::size_t end = 0;    ///< behind the last one
    std::vector<Beam> beams;

    [[nodiscard]] std::size_t scans() const { return end - first; }
    /// What a distance differs from the beam's trend.
    [[nodiscard]] double residual_mm(float mm, std::size_t scan, const Beam& beam) const {
        const double middle = 0.5 * static_cast<double>(first + end - 1);
        return mm - beam.mean_mm - beam.trend_mm * (static_cast<double>(scan) - middle);
    }
};

/// Where the scanner stands, the longest stations first. None: it moves all the time.
[[nodiscard]] std::vector<Station> stations_of(const ScanTable& readings);

/// The stillness of each is told by the scans, and faces by how the beams continue each other.
[[nodiscard]] std::size_t beams_inside(const std::vector<Station>& stations);

}  // namespace scipd::tools
