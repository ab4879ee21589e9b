// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/path_length.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace scipd::sim {

double PathLength::gone_m(double beam) const {
    const auto after = std::ranges::upper_bound(marks_, beam, {}, &Mark::beam);
    if (after == marks_.begin()) return 0.0;
    const Mark& before = *std::prev(after);
    if (after == marks_.end()) return before.gone_m;
    const double share = (beam - before.beam) / (after->beam - before.beam);
    return std::lerp(before.gone_m, after->gone_m, share);
}

double PathLength::beam_at(double gone_m) const {
    const auto after = std::ranges::upper_bound(marks_, gone_m, {}, &Mark::gone_m);
    if (after == marks_.end()) return std::numeric_limits<double>::infinity();
    const Mark& before = *std::prev(after);  // exists: the first mark is 0 m
    const double share = (gone_m - before.gone_m) / (after->gone_m - before.gone_m);
    return std::lerp(before.beam, after->beam, share);
}

}  // namespace scipd::sim
