// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where B's readings spread more or less.
#include <cmath>
#include <limits>

#include "tools/scipcat/compare/difference_parts.h"
#include "tools/scipcat/compare/window_test.h"

namespace scipd::tools::comparing {
namespace {

using ValueOf = double (*)(double deviation);

/// The root makes the deviations of a normal distribution nearly symmetric, and outliers small.
double root(double deviation) {
    return std::sqrt(std::abs(deviation));
}

double square(double deviation) {
    return deviation * deviation;
}

/// Each reading's deviation from its beam's middle, in the beam's own deviations.
Tables deviations_of(const Matter& matter, ValueOf value_of) {
    Tables tables(matter);
    tables.a.fill([&](std::size_t scan, std::size_t pair) {
        const double range_mm = matter.a.range_mm(scan, matter.pairs[pair].a);
        return value_of((range_mm - matter.of_a(pair).median_mm) / matter.usual_sd_mm(pair));
    });
    tables.b.fill([&](std::size_t scan, std::size_t pair) {
        const double range_mm = matter.b.range_mm(scan, matter.pairs[pair].b);
        return value_of((range_mm - matter.of_b(pair).median_mm) / matter.usual_sd_mm(pair));
    });
    return tables;
}

/// Standard deviations pair by pair; NaN where not both see something.
struct Spreads {
    std::vector<bool> tested;
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> usual;
    std::vector<double> drift;        ///< from A's first half to its second
    std::vector<double> quiet_drift;  ///< the same where nothing moves
};

Spreads spreads_of(const Matter& matter) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Spreads spreads;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        const bool tested = matter.see_the_same(pair);
        const std::size_t beam = matter.pairs[pair].a;
        spreads.tested.push_back(tested);
        spreads.a.push_back(tested ? matter.of_a(pair).sd_mm : none);
        spreads.b.push_back(tested ? matter.of_b(pair).sd_mm : none);
        spreads.usual.push_back(tested ? matter.usual_sd_mm(pair) : none);
        spreads.drift.push_back(matter.second_half[beam].sd_mm - matter.first_half[beam].sd_mm);
        spreads.quiet_drift.push_back(matter.is_quiet(pair) ? spreads.drift.back() : none);
    }
    return spreads;
}

Effects effects_of_spread(const Matter& matter, const Spreads& spreads) {
    Effects effects;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        effects.values.push_back(spreads.b[pair] - spreads.a[pair]);
        // A standard deviation itself deviates by sd / sqrt(2 n), by the normal distribution.
        effects.deviations.push_back(spreads.usual[pair] / std::sqrt(matter.fewer_distances(pair)));
    }
    return effects;
}

/// How many times B's spread is A's.
double times(const Drawn& a, const Drawn& b) {
    return std::sqrt(b.mean() / a.mean());
}

}  // namespace

std::vector<Difference> spread_differences(const Matter& matter, double chance) {
    constexpr double least_share = 0.05;
    const Spreads spreads = spreads_of(matter);
    const Tables roots = deviations_of(matter, root);
    const Tables squares = deviations_of(matter, square);
    const std::vector<double> evenly(matter.pairs.size(), 1.0);
    const auto signs = find_differing(roots.a, roots.b, spreads.tested,
                                      {.quantity = Quantity::deviations, .chance = chance});
    std::vector<Difference> differences;
    for (const Run& run : runs_of(signs, effects_of_spread(matter, spreads))) {
        Difference difference = difference_at(matter, What::sd, run);
        difference.a = median_in_run(spreads.a, run);
        difference.b = median_in_run(spreads.b, run);
        difference.effect = difference.difference() / median_in_run(spreads.usual, run);
        const double drift = std::fmax(std::abs(mean_in_run(spreads.drift, run)),
                                       floor_of_runs(spreads.quiet_drift, run));
        const double least = std::fmax(least_share * difference.a, drift);
        if (!(std::abs(difference.difference()) > least)) continue;
        const Interval ratio = drawn_interval(squares, run, evenly, times);
        if (ratio.holds(1)) continue;
        // The interval is of the spread of all readings, the values are of the middle beam.
        const double half_mm = difference.a * (ratio.high - ratio.low) / 2;
        difference.by = {difference.difference() - half_mm, difference.difference() + half_mm};
        differences.push_back(difference);
    }
    return differences;
}

}  // namespace scipd::tools::comparing
