// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which beam of B looks at what a beam of A looks at. Functions of numbers; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/expected.h"
#include "tools/analysis/scan_table.h"
#include "tools/scipcat/compare/outline.h"
#include "tools/scipcat/compare/planar_fit.h"

namespace scipd::tools::comparing {

struct BeamPair {
    std::size_t a = 0;
    std::size_t b = 0;
    double nearer_mm = 0;     ///< from B's place the same thing is so much nearer than from A's
    double uncertain_mm = 0;  ///< the standard deviation of that
    bool at_edge = false;     ///< beside another surface, for A or for B
    bool comparable = true;   ///< false: since B stands elsewhere, it need not see the same thing
};

/// A and B with angles.
[[nodiscard]] std::vector<BeamPair> pairs_by_angle(const Outline& a, const Outline& b,
                                                   const FittedMotion& fitted,
                                                   const std::vector<bool>& edges_a,
                                                   const std::vector<bool>& edges_b);

/// By step numbers, or one after the other where those are not known either. The fault is a
/// sentence that says why they do not belong together.
[[nodiscard]] sim::Expected<std::vector<BeamPair>> pairs_by_number(
    const ScanTable& a, const ScanTable& b, const std::vector<bool>& edges_a,
    const std::vector<bool>& edges_b);

}  // namespace scipd::tools::comparing
