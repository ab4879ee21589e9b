// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/statistics/code_shares.h"

#include <numeric>
#include <vector>

namespace scipd::tools {

CodeShares code_shares(const ScanSeries& series, std::span<const std::size_t> beams,
                       ScanSpan scans) {
    CodeShares shares;
    for (std::size_t scan = scans.first; scan < scans.end; ++scan) {
        for (const std::size_t beam : beams) {
            const Code code = series.code(scan, beam);
            if (code != codes::distance) shares[code] += 1;
        }
    }
    const auto readings = static_cast<double>(scans.count() * beams.size());
    for (auto& [code, share] : shares)
        share /= readings;
    return shares;
}

CodeShares code_shares(const ScanSeries& series) {
    std::vector<std::size_t> beams(series.beams());
    std::iota(beams.begin(), beams.end(), 0);
    return code_shares(series, beams, all_scans(series));
}

}  // namespace scipd::tools
