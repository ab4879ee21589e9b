// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Neighbouring pairs of beams that differ in one way, as runs. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <vector>

namespace scipd::tools::comparing {

/// From `first` to `last`, both within.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
};

/// How much each pair differs, and how sure that is. NaN where it cannot be told.
struct Effects {
    std::vector<double> values;
    std::vector<double> deviations;  ///< of these values
};

/// Runs of one sign; one or two pairs between that differ by nothing do not part them. A run whose
/// parts differ by other amounts, by half and more, is taken apart.
[[nodiscard]] std::vector<Run> runs_of(const std::vector<int>& signs, const Effects& effects);

}  // namespace scipd::tools::comparing
