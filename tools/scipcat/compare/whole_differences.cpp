// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/whole_differences.h"

#include <algorithm>
#include <cmath>

#include "tools/analysis/beam_statistics.h"

namespace scipd::tools::comparing {
namespace {

/// 95 % of a normal distribution are within so many deviations of its middle.
constexpr double deviations_in_interval = 3.92;
/// There are but three such quantities, so four deviations are hardly ever chance.
constexpr double surely = 4;

using Noises = std::vector<SharedNoise>;

Noises noise_of_blocks(const ScanTable& series, const std::vector<BeamStatistics>& beams,
                       const std::vector<ScanSpan>& blocks) {
    const auto edges = beside_edges(beams);
    Noises noises;
    for (const ScanSpan& block : blocks)
        noises.push_back(shared_noise(series, beams, edges, block));
    return noises;
}

double correlation_of(const Noises& noises, const Draw& draw) {
    SharedNoise all;
    for (std::size_t block = 0; block < noises.size(); ++block) {
        const SharedNoise& noise = noises[block];
        all += {draw[block] * noise.products, draw[block] * noise.squares,
                draw[block] * noise.next_squares};
    }
    return all.correlation();
}

double drift_of_correlation(const Noises& noises) {
    Draw first(noises.size(), 0.0);
    std::fill_n(first.begin(), first.size() / 2, 1.0);
    Draw second(noises.size(), 1.0);
    std::fill_n(second.begin(), second.size() / 2, 0.0);
    return correlation_of(noises, second) - correlation_of(noises, first);
}

void compare_neighbours(const Matter& matter, Comparison& comparison) {
    constexpr double least = 0.05;
    const Noises a = noise_of_blocks(matter.a, matter.beams_a, matter.blocks_a);
    const Noises b = noise_of_blocks(matter.b, matter.beams_b, matter.blocks_b);
    comparison.a.neighbours = correlation_of(a, Draw(a.size(), 1.0));
    comparison.b.neighbours = correlation_of(b, Draw(b.size(), 1.0));
    const Interval by = bootstrap(a.size(), b.size(), [&](const Draw& of_a, const Draw& of_b) {
        return correlation_of(b, of_b) - correlation_of(a, of_a);
    });
    comparison.neighbours_within = by;
    const double difference = comparison.b.neighbours - comparison.a.neighbours;
    const double chance = surely * (by.high - by.low) / deviations_in_interval;
    const double floor = std::fmax(least, std::abs(drift_of_correlation(a)));
    if (!(std::abs(difference) > std::max(chance, floor))) return;
    comparison.differ.push_back({.what = What::neighbours,
                                 .first_pair = 0,
                                 .last_pair = matter.pairs.size() - 1,
                                 .from = matter.step(0),
                                 .to = matter.step(matter.pairs.size() - 1),
                                 .a = comparison.a.neighbours,
                                 .b = comparison.b.neighbours,
                                 .by = by,
                                 .effect = std::nan("")});
}

/// How far a rate may be off by jitter and rounding of the first and the last scan.
double uncertainty_hz(const Side& side, double tick_s) {
    const double jitter_s = std::max(*side.stamps.jitter_ms / 1e3, tick_s);
    const double seconds = static_cast<double>(side.scans) / *side.stamps.rate_hz;
    return surely * std::sqrt(2.0) * jitter_s / seconds * *side.stamps.rate_hz;
}

void compare_rates(const Matter& matter, Comparison& comparison) {
    constexpr double least_share = 1e-3;  // the mirror's speed is no better than that
    const Side& a = comparison.a;
    const Side& b = comparison.b;
    if (!a.stamps.rate_hz || !b.stamps.rate_hz) return;
    const double difference = *b.stamps.rate_hz - *a.stamps.rate_hz;
    const double by =
        std::hypot(uncertainty_hz(a, matter.a.tick_s), uncertainty_hz(b, matter.b.tick_s));
    if (!(std::abs(difference) > std::max(by, least_share * *a.stamps.rate_hz))) return;
    comparison.differ.push_back({.what = What::rate,
                                 .a = *a.stamps.rate_hz,
                                 .b = *b.stamps.rate_hz,
                                 .by = {difference - by / 2, difference + by / 2},
                                 .effect = std::nan("")});
}

void compare_clocks(Comparison& comparison) {
    constexpr double least_ppm = 2;
    const auto& a = comparison.a.stamps.clock;
    const auto& b = comparison.b.stamps.clock;
    if (!a || !b) return;
    const double difference = b->ppm - a->ppm;
    // They add: what a busy machine tells late in one recording is not chance.
    const double by = a->uncertainty_ppm + b->uncertainty_ppm;
    if (!(std::abs(difference) > std::max(by, least_ppm))) return;
    comparison.differ.push_back({.what = What::clock,
                                 .a = a->ppm,
                                 .b = b->ppm,
                                 .by = {difference - by / 2, difference + by / 2},
                                 .effect = std::nan("")});
}

struct Moments {
    double count = 0;
    double differences_mm = 0;  ///< from A's means
    double squares = 0;         ///< of deviations, in those of the beam
};

Moments moments_of(const ScanTable& series, ScanSpan block, std::size_t beam, double reference_mm,
                   double own_mean_mm, double sd_mm) {
    Moments moments;
    for (std::size_t scan = block.first; scan < block.end; ++scan) {
        const double range_mm = series.range_mm(scan, beam);
        if (std::isnan(range_mm)) continue;
        moments.count += 1;
        moments.differences_mm += range_mm - reference_mm;
        moments.squares += std::pow((range_mm - own_mean_mm) / sd_mm, 2);
    }
    return moments;
}

std::vector<Moments> moments_of_blocks(const Matter& matter, const std::vector<std::size_t>& pairs,
                                       bool of_a) {
    const ScanTable& series = of_a ? matter.a : matter.b;
    std::vector<Moments> all;
    for (const ScanSpan& block : of_a ? matter.blocks_a : matter.blocks_b) {
        Moments& moments = all.emplace_back();
        for (const std::size_t pair : pairs) {
            const BeamPair& at = matter.pairs[pair];
            const double reference_mm = matter.of_a(pair).mean_mm - (of_a ? 0 : at.nearer_mm);
            const double own_mm = of_a ? matter.of_a(pair).mean_mm : matter.of_b(pair).mean_mm;
            const Moments here = moments_of(series, block, of_a ? at.a : at.b, reference_mm, own_mm,
                                            matter.usual_sd_mm(pair));
            moments.count += here.count;
            moments.differences_mm += here.differences_mm;
            moments.squares += here.squares;
        }
    }
    return all;
}

Moments drawn_moments(const std::vector<Moments>& blocks, const Draw& draw) {
    Moments all;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        all.count += draw[i] * blocks[i].count;
        all.differences_mm += draw[i] * blocks[i].differences_mm;
        all.squares += draw[i] * blocks[i].squares;
    }
    return all;
}

}  // namespace

void tell_intervals(const Matter& matter, const std::vector<std::size_t>& pairs,
                    Comparison& comparison) {
    const auto a = moments_of_blocks(matter, pairs, true);
    const auto b = moments_of_blocks(matter, pairs, false);
    comparison.mean_within_mm =
        bootstrap(a.size(), b.size(), [&](const Draw& of_a, const Draw& of_b) {
            const Moments one = drawn_moments(a, of_a);
            const Moments other = drawn_moments(b, of_b);
            return other.differences_mm / other.count - one.differences_mm / one.count;
        });
    const auto times_a = [&](const Draw& of_a, const Draw& of_b) {
        const Moments one = drawn_moments(a, of_a);
        const Moments other = drawn_moments(b, of_b);
        return std::sqrt(other.squares / other.count * one.count / one.squares);
    };
    const double times = times_a(Draw(a.size(), 1.0), Draw(b.size(), 1.0));
    const Interval within = bootstrap(a.size(), b.size(), times_a);
    const double difference_mm = comparison.b.sd_mm - comparison.a.sd_mm;
    comparison.sd_within_mm = {difference_mm + comparison.a.sd_mm * (within.low - times),
                               difference_mm + comparison.a.sd_mm * (within.high - times)};
}

void add_whole_differences(const Matter& matter, Comparison& comparison) {
    compare_neighbours(matter, comparison);
    compare_rates(matter, comparison);
    compare_clocks(comparison);
}

}  // namespace scipd::tools::comparing
