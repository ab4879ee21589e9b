// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where along the fan a quantity of B differs from A's by more than chance allows. Functions of
// numbers; any thread.
//
// Each window of 1, 4, 16, ... beams is a test by B. L. Welch (Biometrika 34, 1947) between the
// means of A's blocks and of B's, so that neighbours that share their noise, and what lasts a few
// scans, make it no surer than it is. Windows are told apart from chance in all of the tests of a
// comparison together (Bonferroni). Small windows come first, and take what they explain out of
// the larger ones: those find what is too faint for one beam.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scipcat/compare/block_table.h"

namespace scipd::tools::comparing {

/// What the quantity is, which says how sure of it one can be where no block varies.
enum class Quantity {
    deviations,  ///< in standard deviations of one reading, or so
    shares,      ///< 0 and 1
};

struct WindowTest {
    Quantity quantity = Quantity::deviations;
    double chance = 1e-6;  ///< of one test to be wrong
};

/// How many tests there are with so many pairs of beams.
[[nodiscard]] std::size_t tests_among(std::size_t pairs);

/// Tells for each pair 0 if all may be chance, 1 where B has more, -1 where it has less. Only
/// pairs with `tested` count.
[[nodiscard]] std::vector<int> find_differing(const BlockTable& a, const BlockTable& b,
                                              const std::vector<bool>& tested,
                                              const WindowTest& test);

}  // namespace scipd::tools::comparing
