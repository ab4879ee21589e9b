// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where B reads nearer or farther, or brighter or darker.
#include <cmath>
#include <limits>

#include "tools/scipcat/compare/difference_parts.h"
#include "tools/scipcat/compare/window_test.h"

namespace scipd::tools::comparing {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A quantity whose mean may differ: how it is read, and what is known of it pair by pair.
struct Level {
    What what;
    float (ScanTable::*reading)(std::size_t scan, std::size_t beam) const;
    std::vector<bool> tested;
    std::vector<double> mean_a;
    std::vector<double> mean_b;       ///< from A's place
    std::vector<double> shift;        ///< from B's readings to those from A's place
    std::vector<double> sd;           ///< of one reading
    std::vector<double> drift;        ///< from A's first half to its second
    std::vector<double> quiet_drift;  ///< the same where nothing moves
    std::vector<double> least;        ///< smaller differences are none
};

void add_pair(Level& level, const Matter& matter, double mean_a, double mean_b, double shift,
              double sd, double drift) {
    const std::size_t pair = level.tested.size();
    const bool tested =
        level.what == What::mean ? matter.both_see(pair) : matter.see_the_same(pair);
    level.tested.push_back(tested);
    level.mean_a.push_back(tested ? mean_a : not_known);
    level.mean_b.push_back(tested ? mean_b + shift : not_known);
    level.shift.push_back(shift);
    level.sd.push_back(sd);
    level.drift.push_back(drift);
    level.quiet_drift.push_back(matter.is_quiet(pair) ? drift : not_known);
}

Level ranges_of(const Matter& matter) {
    constexpr double last_digit_mm = 1;
    constexpr double surely = 3;  // standard deviations of B's place
    Level level{.what = What::mean, .reading = &ScanTable::range_mm};
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        const std::size_t beam = matter.pairs[pair].a;
        add_pair(level, matter, matter.of_a(pair).mean_mm, matter.of_b(pair).mean_mm,
                 matter.pairs[pair].nearer_mm, matter.usual_sd_mm(pair),
                 matter.second_half[beam].mean_mm - matter.first_half[beam].mean_mm);
    }
    for (const BeamPair& pair : matter.pairs)
        level.least.push_back(last_digit_mm + surely * pair.uncertain_mm);
    return level;
}

Level intensities_of(const Matter& matter) {
    constexpr double least_share = 0.01;
    constexpr double rounded = 0.29;
    Level level{.what = What::intensity, .reading = &ScanTable::intensity};
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        const std::size_t beam = matter.pairs[pair].a;
        const BeamStatistics& a = matter.of_a(pair);
        const BeamStatistics& b = matter.of_b(pair);
        add_pair(level, matter, a.intensity, b.intensity, 0,
                 std::max(rounded, (a.intensity_sd + b.intensity_sd) / 2),
                 matter.second_half[beam].intensity - matter.first_half[beam].intensity);
    }
    const double typical = median_in_run(level.mean_a, {0, matter.pairs.size() - 1});
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        // From elsewhere a thing is nearer or farther, and seen at another angle.
        const double moved = 2 * matter.moved_mm / matter.of_a(pair).mean_mm * level.mean_a[pair];
        level.least.push_back(std::max(rounded, least_share * typical) + std::fmax(0, moved));
    }
    return level;
}

Tables tables_of(const Matter& matter, const Level& level) {
    Tables tables(matter);
    tables.a.fill([&](std::size_t scan, std::size_t pair) {
        const double value = (matter.a.*level.reading)(scan, matter.pairs[pair].a);
        return (value - level.mean_a[pair]) / level.sd[pair];
    });
    tables.b.fill([&](std::size_t scan, std::size_t pair) {
        const double value = (matter.b.*level.reading)(scan, matter.pairs[pair].b);
        return (value + level.shift[pair] - level.mean_a[pair]) / level.sd[pair];
    });
    return tables;
}

Effects effects_of(const Matter& matter, const Level& level) {
    Effects effects;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        effects.values.push_back(level.mean_b[pair] - level.mean_a[pair]);
        effects.deviations.push_back(level.sd[pair] * std::sqrt(2 / matter.fewer_distances(pair)));
    }
    return effects;
}

std::vector<Difference> differences_of(const Matter& matter, const Level& level, double chance) {
    const Tables tables = tables_of(matter, level);
    const auto signs = find_differing(tables.a, tables.b, level.tested,
                                      {.quantity = Quantity::deviations, .chance = chance});
    std::vector<Difference> differences;
    for (const Run& run : runs_of(signs, effects_of(matter, level))) {
        Difference difference = difference_at(matter, level.what, run);
        difference.a = mean_in_run(level.mean_a, run);
        difference.b = mean_in_run(level.mean_b, run);
        difference.effect = difference.difference() / median_in_run(level.sd, run);
        const double drift = std::fmax(std::abs(mean_in_run(level.drift, run)),
                                       floor_of_runs(level.quiet_drift, run));
        const double least = std::fmax(mean_in_run(level.least, run), drift);
        if (!(std::abs(difference.difference()) > least)) continue;
        difference.by = drawn_interval(tables, run, level.sd, [](const Drawn& a, const Drawn& b) {
            return b.mean() - a.mean();
        });
        if (!difference.by.holds(0)) differences.push_back(difference);
    }
    return differences;
}

}  // namespace

std::vector<Difference> level_differences(const Matter& matter, double chance) {
    return differences_of(matter, ranges_of(matter), chance);
}

std::vector<Difference> intensity_differences(const Matter& matter, double chance) {
    const auto none = [](const std::vector<BeamStatistics>& beams) {
        return std::ranges::all_of(
            beams, [](const BeamStatistics& beam) { return std::isnan(beam.intensity); });
    };
    if (none(matter.beams_a) || none(matter.beams_b)) return {};
    return differences_of(matter, intensities_of(matter), chance);
}

}  // namespace scipd::tools::comparing
