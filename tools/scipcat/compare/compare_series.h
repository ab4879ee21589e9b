// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Compares two series of scans. Functions of values; any thread.
#pragma once

#include <optional>
#include <string>

#include "sim/expected.h"
#include "tools/analysis/scan_table.h"
#include "tools/analysis/stamp_statistics.h"
#include "tools/scipcat/compare/comparison.h"

namespace scipd::tools::comparing {

/// One of the two, before it is compared.
struct Taken {
    std::string name;
    ScanTable series;
    // What a scanner told that was asked for its time. A recording has no such questions.
    std::optional<ClockRate> clock;
    std::optional<double> latency_ms;
};

/// Four scans of each are the fewest that say anything. The fault says why they cannot be compared.
[[nodiscard]] sim::Expected<Comparison> compare(const Taken& a, const Taken& b, bool fit);

}  // namespace scipd::tools::comparing
