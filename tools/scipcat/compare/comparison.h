// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What was found when two series of scans, A and B, were compared. Values; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/analysis/beam_statistics.h"
#include "tools/analysis/blocks.h"
#include "tools/analysis/scan_table.h"
#include "tools/analysis/stamp_statistics.h"
#include "tools/scipcat/compare/beam_pairs.h"
#include "tools/scipcat/compare/planar_fit.h"

namespace scipd::tools::comparing {

/// All that is said of one of the two. Typical values are those of the middle one of the quiet
/// beams, which look at no edge and at nothing that moves; NaN where nothing is known.
struct Side {
    std::string name;  ///< as the user named it
    sim::ScannerIdentity identity;
    sim::Directions directions;
    std::size_t scans = 0;
    std::size_t steps = 0;
    std::size_t doubles = 0;
    std::size_t odd_ones = 0;
    std::vector<BeamStatistics> beams;
    double sd_mm = 0;
    double neighbours = 0;  ///< correlation of one beam with the next
    double mixed = 0;       ///< share of the distances
    double intensity = 0;
    CodeShares codes;
    StampStatistics stamps;
    std::optional<double> latency_ms;  ///< from the stamp to the arrival of the scan
};

enum class What { mean, sd, codes, intensity, neighbours, rate, clock };

/// One thing that is other in B, by more than chance and by more than A's halves differ.
struct Difference {
    What what = What::mean;
    // A run of pairs, and the steps of A that they are. For neighbours all of them; rate and clock
    // have none.
    std::size_t first_pair = 0;
    std::size_t last_pair = 0;
    int from = 0;
    int to = 0;
    // In millimetres, in the scanner's units of intensity, or the correlation; hertz; millionths.
    double a = 0;
    double b = 0;
    Interval by;         ///< of b - a, which 95 % of such comparisons would find within
    double effect = 0;   ///< b - a in standard deviations of one reading; NaN where there are none
    CodeShares codes_a;  ///< of the codes that differ
    CodeShares codes_b;

    [[nodiscard]] double difference() const { return b - a; }
    [[nodiscard]] bool is_of_steps() const { return what != What::rate && what != What::clock; }
};

/// How much A's second half differs from its first: 19 of 20 quiet beams by less. NaN where no beam
/// is quiet.
struct Floor {
    double mean_mm = 0;
    double sd_mm = 0;
};

struct Comparison {
    Side a;
    Side b;
    bool by_angle = false;               ///< both say where their steps look
    std::optional<PlanarMotion> motion;  ///< where B stands; nothing was fitted, or it could not be
    std::vector<BeamPair> pairs;
    std::vector<int> steps;  ///< of A, pair by pair
    std::vector<double>
        mean_differences_mm;  ///< B − A of each pair, NaN where there is no such thing
    double mean_mm = 0;       ///< B − A over all quiet pairs
    Interval mean_within_mm;
    Interval sd_within_mm;       ///< of the difference
    Interval neighbours_within;  ///< of the difference
    Floor floor;
    std::vector<Difference> differ;

    [[nodiscard]] bool alike() const { return differ.empty(); }
};

}  // namespace scipd::tools::comparing
