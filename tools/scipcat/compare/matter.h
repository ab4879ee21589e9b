// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Two series of scans, beam for beam and block for block: what all comparing starts from. A view
// of both series, which must outlive it. Any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/analysis/beam_statistics.h"
#include "tools/analysis/blocks.h"
#include "tools/analysis/scan_table.h"
#include "tools/scipcat/compare/beam_pairs.h"

namespace scipd::tools::comparing {

struct Matter {
    const ScanTable& a;
    const ScanTable& b;
    std::vector<BeamPair> pairs;
    double moved_mm = 0;  ///< how far from A B stands
    std::vector<BeamStatistics> beams_a;
    std::vector<BeamStatistics> beams_b;
    std::vector<BeamStatistics> first_half;  ///< of A's scans
    std::vector<BeamStatistics> second_half;
    std::vector<ScanSpan> blocks_a;
    std::vector<ScanSpan> blocks_b;

    [[nodiscard]] const BeamStatistics& of_a(std::size_t pair) const {
        return beams_a[pairs[pair].a];
    }
    [[nodiscard]] const BeamStatistics& of_b(std::size_t pair) const {
        return beams_b[pairs[pair].b];
    }
    /// How many readings of the one that has fewer are distances.
    [[nodiscard]] double fewer_distances(std::size_t pair) const {
        return static_cast<double>(std::min(of_a(pair).distances, of_b(pair).distances));
    }
    /// Both mostly see something there, and the same thing if nothing was moved.
    [[nodiscard]] bool both_see(std::size_t pair) const {
        return pairs[pair].comparable && of_a(pair).share >= 0.5 && of_b(pair).share >= 0.5;
    }
    /// They even see one and the same thing, so that its brightness and their noise say something.
    [[nodiscard]] bool see_the_same(std::size_t pair) const {
        constexpr double another_mm = 100;
        return both_see(pair) && std::abs(mean_difference_mm(pair)) < another_mm;
    }
    /// What noise is measured on: both look at one surface, and nothing moves there.
    [[nodiscard]] bool is_quiet(std::size_t pair) const {
        return see_the_same(pair) && !pairs[pair].at_edge && is_steady(of_a(pair)) &&
               is_steady(of_b(pair));
    }
    /// B − A, from A's place.
    [[nodiscard]] double mean_difference_mm(std::size_t pair) const {
        return of_b(pair).mean_mm + pairs[pair].nearer_mm - of_a(pair).mean_mm;
    }
    /// The standard deviation of one reading, which is rounded to a millimetre.
    [[nodiscard]] double usual_sd_mm(std::size_t pair) const {
        constexpr double rounded_mm = 0.29;
        return std::max(rounded_mm, (of_a(pair).sd_mm + of_b(pair).sd_mm) / 2);
    }
    /// The step of A, or its place in the scan where steps have no numbers.
    [[nodiscard]] int step(std::size_t pair) const { return a.step_of(pairs[pair].a); }
};

}  // namespace scipd::tools::comparing
