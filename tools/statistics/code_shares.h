// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often there is no distance, and why. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <map>
#include <span>

#include "tools/statistics/beam_statistics.h"

namespace scipd::tools {

/// The share of each code among all readings of some beams. Distances are not listed.
using CodeShares = std::map<Code, double>;

[[nodiscard]] CodeShares code_shares(const ScanSeries& series, std::span<const std::size_t> beams,
                                     ScanSpan scans);
[[nodiscard]] CodeShares code_shares(const ScanSeries& series);

}  // namespace scipd::tools
