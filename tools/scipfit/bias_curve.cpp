// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/bias_curve.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {

Hats hats_at(const std::vector<double>& knots_mm, double range_mm) {
    if (knots_mm.size() < 2) return {{0, 0}, {1.0, 0.0}};
    const auto behind = std::ranges::upper_bound(knots_mm, range_mm);
    const auto last = knots_mm.size() - 1;
    const auto at =
        std::clamp<std::size_t>(static_cast<std::size_t>(behind - knots_mm.begin()), 1, last);
    const double share =
        std::clamp((range_mm - knots_mm[at - 1]) / (knots_mm[at] - knots_mm[at - 1]), 0.0, 1.0);
    return {{at - 1, at}, {1.0 - share, share}};
}

std::vector<double> knots_for(const Sights& sights, int per_doubling) {
    constexpr std::size_t least_beams = 40;
    const double step = std::exp2(1.0 / per_doubling);
    const double nearly_one = std::sqrt(step);
    std::vector<double> ranges;
    for (const Sight& sight : sights.list)
        ranges.push_back(sight.range_mm);
    std::ranges::sort(ranges);
    if (ranges.empty()) return {};
    const double farthest = ranges.back();
    std::vector<double> knots{ranges.front()};
    const auto below = [&](double range) {
        return static_cast<std::size_t>(std::ranges::lower_bound(ranges, range) - ranges.begin());
    };
    for (double at = knots[0] * step; at * nearly_one < farthest; at *= step) {
        if (below(at) >= below(knots.back()) + least_beams) knots.push_back(at);
    }
    if (farthest < nearly_one * ranges.front()) return {ranges[ranges.size() / 2]};
    if (knots.size() > 1 && ranges.size() < below(knots.back()) + least_beams) knots.pop_back();
    knots.push_back(farthest);
    return knots;
}

double value_at(const std::vector<double>& knots_mm, const std::vector<double>& values,
                double range_mm) {
    const Hats hats = hats_at(knots_mm, range_mm);
    return hats.share[0] * values[hats.knot[0]] + hats.share[1] * values[hats.knot[1]];
}

std::vector<double> knots_between(const std::vector<double>& knots_mm) {
    std::vector<double> knots{knots_mm.front()};
    for (std::size_t i = 1; i < knots_mm.size(); ++i)
        knots.push_back(0.5 * (knots_mm[i - 1] + knots_mm[i]));
    if (knots_mm.size() > 1) knots.push_back(knots_mm.back());
    return knots;
}

LineThrough line_through(const std::vector<double>& knots_mm, const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        x += knots_mm[i] / n;
        y += values[i] / n;
        xx += knots_mm[i] * knots_mm[i] / n;
        xy += knots_mm[i] * values[i] / n;
    }
    const double spread = xx - x * x;
    LineThrough line;
    line.slope = spread > 0.0 ? (xy - x * y) / spread : 0.0;
    line.at_zero = y - line.slope * x;
    for (std::size_t i = 0; i < values.size(); ++i)
        line.left.push_back(values[i] - line.at_zero - line.slope * knots_mm[i]);
    return line;
}

}  // namespace scipd::tools
