// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/differences.h"

#include <cmath>
#include <iterator>

#include "tools/scipcat/compare/difference_parts.h"
#include "tools/scipcat/compare/window_test.h"

namespace scipd::tools::comparing {
namespace {

void append(std::vector<Difference>& all, std::vector<Difference> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

/// Without any noise, as an ideal scanner reads, as well.
bool stands_still(const BeamStatistics& beam) {
    return is_steady(beam) || (beam.share >= 0.9 && beam.sd_mm == 0);
}

}  // namespace

Floor floor_of(const Matter& matter) {
    constexpr double most = 0.95;
    std::vector<double> means_mm;
    std::vector<double> sds_mm;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        const BeamStatistics& first = matter.first_half[matter.pairs[pair].a];
        const BeamStatistics& second = matter.second_half[matter.pairs[pair].a];
        if (matter.pairs[pair].at_edge || !stands_still(first) || !stands_still(second)) continue;
        means_mm.push_back(std::abs(second.mean_mm - first.mean_mm));
        sds_mm.push_back(std::abs(second.sd_mm - first.sd_mm));
    }
    return {quantile_of(std::move(means_mm), most), quantile_of(std::move(sds_mm), most)};
}

std::vector<Difference> find_differences(const Matter& matter) {
    constexpr double wrongly = 0.01;  // of a comparison of two that are alike
    const auto codes = codes_to_compare(matter);
    const auto quantities = static_cast<double>(3 + codes.size());
    const double chance =
        wrongly / (quantities * static_cast<double>(tests_among(matter.pairs.size())));
    std::vector<Difference> differences = level_differences(matter, chance);
    append(differences, spread_differences(matter, chance));
    append(differences, intensity_differences(matter, chance));
    append(differences, code_differences(matter, codes, chance));
    return differences;
}

}  // namespace scipd::tools::comparing
