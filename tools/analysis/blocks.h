// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans in blocks of neighbours in time: what lasts a few scans, such as somebody who walks past,
// counts once and not as often as there are scans. Intervals are found by drawing blocks again and
// again (B. Efron, "Bootstrap methods", 1979), always in the same way, so that the same scans give
// the same answer. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tools/analysis/beam_statistics.h"

namespace scipd::tools {

/// 20 to 40 blocks of five scans or more; with fewer scans than 20 each is a block.
[[nodiscard]] std::size_t blocks_for(std::size_t scans);

/// The blocks of a series, in the order of time, of nearly one length.
[[nodiscard]] std::vector<ScanSpan> blocks_of(ScanSpan scans);

struct Interval {
    double low = 0;
    double high = 0;

    [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
};

/// How often each block was drawn.
using Draw = std::vector<double>;

/// The middle 95 % of what a statistic is over a thousand draws of as many blocks as there are.
[[nodiscard]] Interval bootstrap(std::size_t blocks_a, std::size_t blocks_b,
                                 const std::function<double(const Draw&, const Draw&)>& statistic);

}  // namespace scipd::tools
