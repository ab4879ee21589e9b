// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/difference_parts.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools::comparing {
namespace {

/// The readings of a run in each block.
std::vector<Drawn> blocks_in(const BlockTable& table, const Run& run,
                             const std::vector<double>& weights) {
    std::vector<Drawn> blocks(table.blocks());
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        for (std::size_t pair = run.first; pair <= run.last; ++pair) {
            if (!(weights[pair] > 0)) continue;
            blocks[block].sum += weights[pair] * table.sum(block, pair);
            blocks[block].count += table.count(block, pair);
        }
    }
    return blocks;
}

Drawn drawn(const std::vector<Drawn>& blocks, const Draw& draw) {
    Drawn all;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        all.sum += draw[block] * blocks[block].sum;
        all.count += draw[block] * blocks[block].count;
    }
    return all;
}

std::vector<double> known_in(const std::vector<double>& values, const Run& run) {
    std::vector<double> known;
    for (std::size_t pair = run.first; pair <= run.last; ++pair) {
        if (!std::isnan(values[pair])) known.push_back(values[pair]);
    }
    return known;
}

}  // namespace

Difference difference_at(const Matter& matter, What what, const Run& run) {
    Difference difference{.what = what, .first_pair = run.first, .last_pair = run.last};
    difference.from = matter.step(run.first);
    difference.to = matter.step(run.last) + matter.a.directions.cluster - 1;
    return difference;
}

Interval drawn_interval(const Tables& tables, const Run& run, const std::vector<double>& weights,
                        const std::function<double(const Drawn& a, const Drawn& b)>& statistic) {
    const auto a = blocks_in(tables.a, run, weights);
    const auto b = blocks_in(tables.b, run, weights);
    return bootstrap(a.size(), b.size(), [&](const Draw& draw_a, const Draw& draw_b) {
        return statistic(drawn(a, draw_a), drawn(b, draw_b));
    });
}

double mean_in_run(const std::vector<double>& values, const Run& run) {
    const auto known = known_in(values, run);
    double sum = 0;
    for (const double value : known)
        sum += value;
    return sum / static_cast<double>(known.size());
}

double floor_of_runs(const std::vector<double>& drift, const Run& run) {
    constexpr double most = 0.95;
    const std::size_t length = run.last - run.first + 1;
    const std::size_t stride = std::max<std::size_t>(1, length / 4);
    std::vector<double> sizes;
    for (std::size_t first = 0; first + length <= drift.size(); first += stride) {
        const double mean = mean_in_run(drift, {first, first + length - 1});
        if (!std::isnan(mean)) sizes.push_back(std::abs(mean));
    }
    return quantile_of(std::move(sizes), most);
}

double median_in_run(const std::vector<double>& values, const Run& run) {
    return median_of(known_in(values, run));
}

}  // namespace scipd::tools::comparing
