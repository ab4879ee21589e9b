// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the searches for differences share; used by differences.cpp and its parts alone. Any thread.
#pragma once

#include <functional>
#include <vector>

#include "tools/scipcat/compare/block_table.h"
#include "tools/scipcat/compare/comparison.h"
#include "tools/scipcat/compare/matter.h"
#include "tools/scipcat/compare/runs.h"

namespace scipd::tools::comparing {

/// A quantity of all pairs, in the blocks of A and of B.
struct Tables {
    BlockTable a;
    BlockTable b;

    explicit Tables(const Matter& matter)
        : a(matter.blocks_a, matter.pairs.size()), b(matter.blocks_b, matter.pairs.size()) {}
};

/// The sum and the number of the readings of a run, each weighted: in one block, or in all drawn.
struct Drawn {
    double sum = 0;
    double count = 0;

    [[nodiscard]] double mean() const { return sum / count; }
};

/// The run as a difference without figures.
[[nodiscard]] Difference difference_at(const Matter& matter, What what, const Run& run);

/// What `statistic` makes of A's and B's readings in a run, over draws of blocks. Each pair counts
/// `weights` times.
[[nodiscard]] Interval drawn_interval(
    const Tables& tables, const Run& run, const std::vector<double>& weights,
    const std::function<double(const Drawn& a, const Drawn& b)>& statistic);

/// The mean of these values in a run; NaN are left out.
[[nodiscard]] double mean_in_run(const std::vector<double>& values, const Run& run);
[[nodiscard]] double median_in_run(const std::vector<double>& values, const Run& run);

/// What 19 of 20 runs as long as this one differ by at most from A's first half to its second, if
/// `drift` is what each pair does: noise averages out over a long run, and warming up does not. NaN
/// where that is not known.
[[nodiscard]] double floor_of_runs(const std::vector<double>& drift, const Run& run);

/// Each search may be wrong in any of its tests with this chance.
[[nodiscard]] std::vector<Difference> level_differences(const Matter& matter, double chance);
[[nodiscard]] std::vector<Difference> spread_differences(const Matter& matter, double chance);
[[nodiscard]] std::vector<Difference> intensity_differences(const Matter& matter, double chance);
/// Codes that make a ten-thousandth of the readings of A or B; the eight most frequent.
[[nodiscard]] std::vector<Code> codes_to_compare(const Matter& matter);
[[nodiscard]] std::vector<Difference> code_differences(const Matter& matter,
                                                       const std::vector<Code>& codes,
                                                       double chance);

}  // namespace scipd::tools::comparing
