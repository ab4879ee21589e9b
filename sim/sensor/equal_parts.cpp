// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/equal_parts.h"

#include <algorithm>
#include <cmath>

#include "sim/sensor/encounters.h"

namespace scipd::sim {
namespace {

/// The longest path of any mover, there and back.
double farthest_gone_m(std::span<const Mover> movers, Time from, Time to) {
    double farthest_m = 0.0;
    for (const Mover& mover : movers) {
        double gone_m = 0.0;
        for (const PoseTrack::Leg& leg : mover.path->legs(from, to))
            gone_m += path_length_m(leg, mover.radius_m);
        farthest_m = std::max(farthest_m, gone_m);
    }
    return farthest_m;
}

}  // namespace

Beams equal_part(std::size_t beams, std::size_t i, std::size_t count) {
    const std::size_t first = i * beams / count;
    return {first, (i + 1) * beams / count - first};
}

std::vector<TimedBeams> equal_parts(std::size_t beams, std::size_t most,
                                    const std::function<Time(std::size_t beam)>& fired,
                                    std::span<const Mover> movers) {
    const double gone_m = farthest_gone_m(movers, fired(0), fired(beams - 1));
    const double needed = std::max(1.0, std::ceil(gone_m / moves_within_part_m));
    const auto count = static_cast<std::size_t>(std::min(needed, static_cast<double>(most)));
    std::vector<TimedBeams> parts;
    parts.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Beams part = equal_part(beams, i, count);
        parts.push_back({part, fired(middle_of(part))});
    }
    return parts;
}

}  // namespace scipd::sim
