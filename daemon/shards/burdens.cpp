// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/shards/burdens.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace scipd::daemon {
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
    return shard_of;
}

}  // namespace scipd::daemon
