// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The runs of beams in which B differs from A: by more than chance, and by more than A's halves
// differ there. Functions of numbers; any thread.
#pragma once

#include <vector>

#include "tools/scipcat/compare/comparison.h"
#include "tools/scipcat/compare/matter.h"

namespace scipd::tools::comparing {

[[nodiscard]] Floor floor_of(const Matter& matter);

/// Ranges, their spread, intensities and codes, in this order, each from step to step.
[[nodiscard]] std::vector<Difference> find_differences(const Matter& matter);

}  // namespace scipd::tools::comparing
