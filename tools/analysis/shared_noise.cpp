// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/analysis/shared_noise.h"

#include <cmath>
#include <limits>

namespace scipd::tools {
namespace {

/// Each pair counts the same, however much its beams spread.
SharedNoise noise_of_pair(const ScanTable& series, std::span<const BeamStatistics> beams,
                          std::size_t beam, std::size_t next, ScanSpan scans) {
    SharedNoise noise;
    for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
        const double one = (series.range_mm(scan, beam) - beams[beam].mean_mm) / beams[beam].sd_mm;
        const double other =
            (series.range_mm(scan, next) - beams[next].mean_mm) / beams[next].sd_mm;
        if (std::isnan(one) || std::isnan(other)) continue;
        noise += {one * other, one * one, other * other};
    }
    return noise;
}

}  // namespace

SharedNoise& SharedNoise::operator+=(const SharedNoise& other) {
    products += other.products;
    squares += other.squares;
    next_squares += other.next_squares;
    return *this;
}

double SharedNoise::correlation() const {
    const double both = std::sqrt(squares * next_squares);
    return both > 0 ? products / both : std::numeric_limits<double>::quiet_NaN();
}

SharedNoise shared_noise(const ScanTable& series, std::span<const BeamStatistics> beams,
                         const std::vector<bool>& beside_edges, ScanSpan scans, std::size_t apart) {
    SharedNoise noise;
    for (std::size_t i = 0; i + apart < beams.size(); ++i) {
        const std::size_t next = i + apart;
        const bool smooth = !beside_edges[i] && !beside_edges[next];
        if (smooth && is_steady(beams[i]) && is_steady(beams[next]))
            noise += noise_of_pair(series, beams, i, next, scans);
    }
    return noise;
}

}  // namespace scipd::tools
