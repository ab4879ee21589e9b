// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What belongs to no single step: how neighbours share their noise, how often scans come, and how
// fast the clock runs. Functions of numbers; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scipcat/compare/comparison.h"
#include "tools/scipcat/compare/matter.h"

namespace scipd::tools::comparing {

/// How sure the mean and the standard deviation over these pairs are.
void tell_intervals(const Matter& matter, const std::vector<std::size_t>& pairs,
                    Comparison& comparison);

/// Adds the correlations of neighbours, and which of all these differ.
void add_whole_differences(const Matter& matter, Comparison& comparison);

}  // namespace scipd::tools::comparing
