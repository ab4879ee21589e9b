// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What pictures of a comparison show: both from above, and each step's figures. Functions of
// values; any thread.
#pragma once

#include <string>
#include <vector>

#include "tools/scipcat/compare/comparison.h"

namespace scipd::tools::comparing {

/// How a pair of beams stands in the picture.
enum class Mark { alike, nearer, farther, otherwise };

/// The strongest of what differs at each pair: a range before a spread, an intensity or a code.
[[nodiscard]] std::vector<Mark> marks_of(const Comparison& comparison);

/// In the frame of A, x forward.
struct SeenPoint {
    double x_m = 0;
    double y_m = 0;
    std::size_t pair = 0;
};

/// A's points or B's, both along A's beams, as B would be seen from A's place. Empty where A does
/// not say where its steps look.
[[nodiscard]] std::vector<SeenPoint> points_of(const Comparison& comparison, bool of_a);

/// Words at the middle of a run.
struct RunLabel {
    SeenPoint at;
    Mark mark = Mark::alike;
    std::string text;
};
/// Labels for the runs that matter most; no two at one place.
[[nodiscard]] std::vector<RunLabel> labels_of(const Comparison& comparison);

/// A value of each side for each pair; NaN where there is none.
struct Curve {
    std::vector<double> a;
    std::vector<double> b;
};
[[nodiscard]] Curve spreads_by_step(const Comparison& comparison);
[[nodiscard]] Curve intensities_by_step(const Comparison& comparison);

/// How far an axis goes so that all but some hundredths of these are on it.
[[nodiscard]] double reach_of(const std::vector<double>& values);

}  // namespace scipd::tools::comparing
