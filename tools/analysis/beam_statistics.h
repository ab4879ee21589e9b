// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Statistics of each beam of a table of scans. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "tools/analysis/scan_table.h"

namespace scipd::tools {

/// Scans of a series, from `first` up to, not with, `end`.
struct ScanSpan {
    std::size_t first = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t count() const { return end - first; }
};
[[nodiscard]] inline ScanSpan all_scans(const ScanTable& series) {
    return {0, series.scans()};
}

/// Statistics of those readings of a beam that are distances. All is NaN where there are none; so
/// is the spread of one.
struct BeamStatistics {
    std::size_t distances = 0;
    double share = 0;  ///< of all readings that are distances
    double mean_mm = 0;
    double sd_mm = 0;
    double median_mm = 0;
    double quiet_sd_mm = 0;  ///< as the middle half spreads: what moves now and then has no part
    double intensity = 0;    ///< mean; NaN where none were recorded
    double intensity_sd = 0;
};

[[nodiscard]] std::vector<BeamStatistics> beam_statistics(const ScanTable& series, ScanSpan scans);

/// It gives a distance in nine of ten scans, and its readings gather about one.
[[nodiscard]] bool is_steady(const BeamStatistics& beam);

/// For each beam, whether a neighbour looks at another surface, or at none.
[[nodiscard]] std::vector<bool> beside_edges(std::span<const BeamStatistics> beams);

/// Whether two neighbours at these ranges seem to be on one surface: they are no farther apart than
/// on a wall that the beam hits at some 7 degrees.
[[nodiscard]] bool on_one_surface(double range_mm, double next_mm, double increment_rad);

/// The share of distances that hang between two surfaces: the beams before and after are more than
/// 0.2 m apart, and the reading is at least a tenth of that from both. The beam hits both surfaces,
/// and the scanner tells a distance in the middle.
[[nodiscard]] double mixed_share(const ScanTable& series, std::span<const BeamStatistics> beams,
                                 ScanSpan scans);

/// Sums over pairs of beams, so that those of several scans can be added up.
struct SharedNoise {
    double products = 0;  ///< of the deviations of both beams
    double squares = 0;   ///< of those of one
    double next_squares = 0;

    SharedNoise& operator+=(const SharedNoise& other);
    /// NaN where there was no noise.
    [[nodiscard]] double correlation() const;
};

/// Shared noise of pairs of beams, `apart` steps from each other. Both must be steady and look at
/// no edge. `beams` are the means about which they deviate.
[[nodiscard]] SharedNoise shared_noise(const ScanTable& series,
                                       std::span<const BeamStatistics> beams,
                                       const std::vector<bool>& beside_edges, ScanSpan scans,
                                       std::size_t apart = 1);

/// Share of each class of codes among all readings of some beams. Distances are not listed.
using CodeShares = std::map<Code, double>;
[[nodiscard]] CodeShares code_shares(const ScanTable& series, std::span<const std::size_t> beams,
                                     ScanSpan scans);
[[nodiscard]] CodeShares code_shares(const ScanTable& series);

/// The middle one; of an even number the mean of the two in the middle. NaN of none.
[[nodiscard]] double median_of(std::vector<double> values);
/// The value that this share of the values is below. NaN of none.
[[nodiscard]] double quantile_of(std::vector<double> values, double share);

}  // namespace scipd::tools
