// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a recording stands still, and which beams see something still that is no edge: what noise
// can be learned from. Values; one thread.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/analysis/scan_table.h"
#include "tools/scipfit/beam.h"

namespace scipd::tools {

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
