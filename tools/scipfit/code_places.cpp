// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/code_places.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

void count(const ScanTable& readings, std::size_t scan, std::size_t step, CodeCounts& counts) {
    const bool before = step > 0 && is_distance(readings.range_mm(scan, step - 1));
    const bool after = step + 1 < readings.beams && is_distance(readings.range_mm(scan, step + 1));
    if (before && after)
        counts.edge += 1.0;
    else if (before || after)
        counts.beside += 1.0;
    else
        counts.inside += 1.0;
}

}  // namespace

std::uint32_t CodeShares::usual() const {
    return std::ranges::max_element(codes, {}, [](const auto& one) { return one.second.all(); })
        ->first;
}

CodeShares codes_of(const ScanTable& readings) {
    CodeShares shares;
    for (std::size_t scan = 0; scan < readings.scans(); ++scan) {
        for (std::size_t step = 0; step < readings.beams; ++step) {
            const Code code = readings.code(scan, step);
            shares.readings += 1.0;
            if (code == codes::distance) continue;
            count(readings, scan, step, shares.all);
            if (code < 0) continue;
            CodeCounts& counts = shares.codes[static_cast<std::uint32_t>(code)];
            count(readings, scan, step, counts);
            if (step > 0 && readings.code(scan, step - 1) == code) counts.pairs += 1.0;
        }
    }
    return shares;
}

LostBeams lost_beams(const Standing& standing) {
    LostBeams lost;
    double count = 0.0;
    for (const Station& station : standing.stations) {
        for (const Beam& beam : station.beams) {
            if (!beam.inside) continue;
            lost.readings += static_cast<double>(station.scans());
            count += static_cast<double>(station.scans() - beam.count);
        }
    }
    if (lost.readings == 0.0) return lost;
    lost.share = count / lost.readings;
    // Wilson's interval: it is not empty where none was lost.
    constexpr double z = 1.96;
    const double n = lost.readings;
    const double middle = lost.share + z * z / (2.0 * n);
    const double half = z * std::sqrt(lost.share * (1.0 - lost.share) / n + z * z / (4.0 * n * n));
    lost.high = (middle + half) / (1.0 + z * z / n);
    return lost;
}

}  // namespace scipd::tools
