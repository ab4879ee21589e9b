// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner reads too far, as a curve over the range: straight between its knots, as scipd has
// it. Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tools/scipfit/sight.h"

namespace scipd::tools {

/// How much of two knots a range has.
struct Hats {
    std::array<std::size_t, 2> knot{};
    std::array<double, 2> share{};
};

/// `knots_mm` grow.
[[nodiscard]] Hats hats_at(const std::vector<double>& knots_mm, double range_mm);

/// From the nearest to the farthest range that is seen, so many for each doubling, and many beams
/// between two of them. One knot where all ranges are nearly one.
[[nodiscard]] std::vector<double> knots_for(const Sights& sights, int per_doubling);

/// Straight between its knots, and level beyond them.
[[nodiscard]] double value_at(const std::vector<double>& knots_mm,
                              const std::vector<double>& values, double range_mm);

/// The first, those halfway between two, and the last.
[[nodiscard]] std::vector<double> knots_between(const std::vector<double>& knots_mm);

/// The straight line that lies nearest to the curve at its knots, and what is left of the curve.
struct LineThrough {
    double at_zero = 0.0;
    double slope = 0.0;
    std::vector<double> left;  ///< at each knot
};

[[nodiscard]] LineThrough line_through(const std::vector<double>& knots_mm,
                                       const std::vector<double>& values);

}  // namespace scipd::tools
