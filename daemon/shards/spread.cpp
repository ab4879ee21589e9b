// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/spread.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace scipd::daemon {
namespace {

/// Shards that differ by less, as a share of what each has to do on the average, are even.
constexpr double even_enough = 0.05;

/// What had best go from where there is most to where there is least: the nearest to half of what
/// they differ by. Nothing: no move would make them less uneven.
std::optional<std::size_t> best_to_move(std::span<const Burden> burdens,
                                        std::span<const std::size_t> shard_of, std::size_t from,
                                        double gap) {
    std::optional<std::size_t> best;
    const auto off = [&](std::size_t i) { return std::abs(burdens[i].cost - gap / 2.0); };
    for (std::size_t i = 0; i < burdens.size(); ++i) {
        if (!burdens[i].may_move || shard_of[i] != from || off(i) >= 0.49 * gap) continue;
        if (!best || off(i) < off(*best)) best = i;
    }
    return best;
}

// Each move makes the sum of the squares of the loads less by a share, so it ends.
void even_out(std::span<const Burden> burdens, std::span<double> load,
              std::span<std::size_t> shard_of) {
    const double mean = std::accumulate(load.begin(), load.end(), 0.0) / double(load.size());
    for (;;) {
        const auto [least, most] = std::ranges::minmax_element(load);
        const double gap = *most - *least;
        if (gap <= even_enough * mean) return;
        const auto moved =
            best_to_move(burdens, shard_of, static_cast<std::size_t>(most - load.begin()), gap);
        if (!moved) return;
        shard_of[*moved] = static_cast<std::size_t>(least - load.begin());
        *most -= burdens[*moved].cost;
        *least += burdens[*moved].cost;
    }
}

}  // namespace

// The largest first, each where there is least: never more than a third above the best there is
// (Graham, "Bounds on multiprocessing timing anomalies", 1969).
std::vector<std::size_t> spread(std::span<const Burden> burdens, std::size_t shards) {
    assert(shards > 0);
    std::vector<double> load(shards, 0.0);
    std::vector<std::size_t> shard_of(burdens.size());
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < burdens.size(); ++i) {
        const Burden& burden = burdens[i];
        if (!burden.held) {
            free.push_back(i);
            continue;
        }
        shard_of[i] = std::min(*burden.held, shards - 1);
        load[shard_of[i]] += burden.cost;
    }
    std::ranges::stable_sort(free, std::ranges::greater{},
                             [&](std::size_t i) { return burdens[i].cost; });
    for (const std::size_t i : free) {
        const auto least = std::ranges::min_element(load);
        shard_of[i] = static_cast<std::size_t>(least - load.begin());
        *least += burdens[i].cost;
    }
    even_out(burdens, load, shard_of);
    return shard_of;
}

}  // namespace scipd::daemon
