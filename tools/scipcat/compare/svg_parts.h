// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Drawings of a comparison inside of a page, in the colours of its style sheet. Any thread; nothing
// shared.
#pragma once

#include <string>

#include "tools/scipcat/compare/comparison.h"
#include "tools/scipcat/compare/comparison_view.h"

namespace scipd::tools::comparing {

/// What both see from above. Empty where the directions are not known.
[[nodiscard]] std::string svg_from_above(const Comparison& comparison);

/// How much nearer or farther each step is, with the floor as a band.
[[nodiscard]] std::string svg_of_differences(const Comparison& comparison);

/// A's and B's values, step by step, from 0 on.
[[nodiscard]] std::string svg_of_curves(const Comparison& comparison, const Curve& curve);

}  // namespace scipd::tools::comparing
