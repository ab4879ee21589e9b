// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/compare_series.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "tools/scipcat/compare/differences.h"
#include "tools/scipcat/compare/matter.h"
#include "tools/scipcat/compare/whole_differences.h"

namespace scipd::tools::comparing {
namespace {

constexpr std::size_t fewest_scans = 4;

/// Whichever is known better.
std::optional<ClockRate> better_of(const std::optional<ClockRate>& one,
                                   const std::optional<ClockRate>& other) {
    if (!one || !other) return one ? one : other;
    return one->uncertainty_ppm < other->uncertainty_ppm ? one : other;
}

Side side_of(const Taken& taken, std::vector<BeamStatistics> beams) {
    const ScanTable& series = taken.series;
    Side side{.name = taken.name,
              .identity = series.identity,
              .directions = series.directions,
              .scans = series.scans(),
              .steps = series.beams,
              .doubles = series.doubles,
              .odd_ones = series.odd_ones};
    side.mixed = mixed_share(series, beams, all_scans(series));
    side.codes = code_shares(series);
    side.stamps = stamp_statistics(series.times, series.tick_s);
    side.stamps.clock = better_of(side.stamps.clock, taken.clock);
    side.latency_ms = taken.latency_ms;
    side.beams = std::move(beams);
    return side;
}

Matter matter_of(const ScanTable& a, const ScanTable& b) {
    const std::size_t middle = a.scans() / 2;
    return {.a = a,
            .b = b,
            .pairs = {},
            .moved_mm = 0,
            .beams_a = beam_statistics(a, all_scans(a)),
            .beams_b = beam_statistics(b, all_scans(b)),
            .first_half = beam_statistics(a, {0, middle}),
            .second_half = beam_statistics(a, {middle, a.scans()}),
            .blocks_a = blocks_of(all_scans(a)),
            .blocks_b = blocks_of(all_scans(b))};
}

/// The pairs that typical values are of: the quiet ones, or all that see something if there are
/// none.
std::vector<std::size_t> typical_pairs(const Matter& matter) {
    std::vector<std::size_t> quiet;
    std::vector<std::size_t> seen;
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        if (matter.is_quiet(pair)) quiet.push_back(pair);
        if (matter.both_see(pair)) seen.push_back(pair);
    }
    return quiet.empty() ? seen : quiet;
}

double mean_of_pairs(const std::vector<double>& values, const std::vector<std::size_t>& pairs) {
    double sum = 0;
    for (const std::size_t pair : pairs)
        sum += values[pair];
    return sum / static_cast<double>(pairs.size());
}

void tell_levels(const Matter& matter, Comparison& comparison) {
    const auto typical = typical_pairs(matter);
    for (std::size_t pair = 0; pair < matter.pairs.size(); ++pair) {
        comparison.steps.push_back(matter.step(pair));
        comparison.mean_differences_mm.push_back(
            matter.both_see(pair) ? matter.mean_difference_mm(pair) : std::nan(""));
    }
    comparison.mean_mm = mean_of_pairs(comparison.mean_differences_mm, typical);
    const auto middle = [&](bool of_a, auto value) {
        std::vector<double> values;
        for (const std::size_t pair : typical)
            values.push_back((of_a ? matter.of_a(pair) : matter.of_b(pair)).*value);
        return median_of(std::move(values));
    };
    comparison.a.sd_mm = middle(true, &BeamStatistics::sd_mm);
    comparison.b.sd_mm = middle(false, &BeamStatistics::sd_mm);
    comparison.a.intensity = middle(true, &BeamStatistics::intensity);
    comparison.b.intensity = middle(false, &BeamStatistics::intensity);
    tell_intervals(matter, typical, comparison);
}

/// How the beams belong together, and where B stands.
sim::Expected<std::vector<BeamPair>> pair_up(const Matter& matter, bool fit,
                                             Comparison& comparison) {
    const auto edges_a = beside_edges(matter.beams_a);
    const auto edges_b = beside_edges(matter.beams_b);
    const auto a = outline_of(matter.a.directions, matter.beams_a);
    const auto b = outline_of(matter.b.directions, matter.beams_b);
    if (!a || !b) return pairs_by_number(matter.a, matter.b, edges_a, edges_b);
    comparison.by_angle = true;
    const auto fitted = fit ? fit_motion(*a, *b) : std::nullopt;
    if (fitted) comparison.motion = fitted->motion;
    return pairs_by_angle(*a, *b, fitted.value_or(FittedMotion{}), edges_a, edges_b);
}

}  // namespace

sim::Expected<Comparison> compare(const Taken& taken_a, const Taken& taken_b, bool fit) {
    const ScanTable& a = taken_a.series;
    const ScanTable& b = taken_b.series;
    for (const Taken* taken : {&taken_a, &taken_b}) {
        const std::size_t scans = taken->series.scans();
        if (scans < fewest_scans)
            return sim::refuse(taken->name + " has " + std::to_string(scans) +
                               (scans == 1 ? " scan" : " scans that differ") +
                               "; at least 4 are needed, and 100 are better");
    }
    Matter matter = matter_of(a, b);
    Comparison comparison;
    auto pairs = pair_up(matter, fit, comparison);
    if (!pairs) return tl::unexpected(pairs.error());
    if (pairs->empty()) return sim::refuse("A and B see nothing in common");
    matter.pairs = *std::move(pairs);
    if (comparison.motion) matter.moved_mm = glm::length(comparison.motion->shift_mm);
    comparison.a = side_of(taken_a, matter.beams_a);
    comparison.b = side_of(taken_b, matter.beams_b);
    comparison.floor = floor_of(matter);
    tell_levels(matter, comparison);
    comparison.differ = find_differences(matter);
    add_whole_differences(matter, comparison);
    comparison.pairs = std::move(matter.pairs);
    return comparison;
}

}  // namespace scipd::tools::comparing
