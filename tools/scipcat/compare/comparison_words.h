// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A comparison in words and rows, which all reports share. Any thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "tools/scipcat/compare/comparison.h"

namespace scipd::tools::comparing {

/// "steps 210–221 nearer by 0.31 m (0.30 to 0.32)"
[[nodiscard]] std::string sentence_of(const Difference& difference);

/// "They are alike: …" or "They differ in 3 things."
[[nodiscard]] std::string verdict_of(const Comparison& comparison);

/// Why there is no floor; empty where there is one.
[[nodiscard]] std::string missing_floor(const Comparison& comparison);

/// Where B stands, or why that is not known.
[[nodiscard]] std::string place_of(const Comparison& comparison);

/// "UST-10LX  ·  serial H0000042  ·  100 scans of 1081 steps", and what was left out.
[[nodiscard]] std::string scanner_of(const Side& side);

/// A row of the table that has both sides; a text is empty where it is not known.
struct Row {
    std::string what;
    std::string a;
    std::string b;
    std::string difference;
    std::string floor;
};
[[nodiscard]] std::vector<Row> overview_of(const Comparison& comparison);

/// "no distance: 12 %, 6: 0.1 %": the largest first.
[[nodiscard]] std::string share_list(const CodeShares& shares);

/// Those that matter most first: many steps, and much.
[[nodiscard]] std::vector<Difference> weightiest_first(std::vector<Difference> differences);

}  // namespace scipd::tools::comparing
