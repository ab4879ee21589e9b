// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/error_model.h"

#include <algorithm>
#include <cassert>

#include "sim/random.h"

namespace scipd::sim {

void ErrorModel::read(const SensorSpec& spec, std::int64_t revolution, std::span<const Hit> hits,
                      std::span<float> range_m) const {
    assert(hits.size() == range_m.size());
    const Chance chance(
        {.seed = seed, .sensor = sensor, .scan = static_cast<std::uint64_t>(revolution)});
    const bool noisy = accuracy == Accuracy::sensor && !spec.noise.empty();
    for (std::size_t i = 0; i < hits.size(); ++i) {
        range_m[i] = hits[i].range_m;
        if (!noisy || !hits[i].met()) continue;
        const double noise = chance.standard_normal(static_cast<std::uint32_t>(i));
        const double read_m = hits[i].range_m + spec.sigma_m(hits[i].range_m) * noise;
        range_m[i] = static_cast<float>(std::max(0.0, read_m));
    }
}

}  // namespace scipd::sim
