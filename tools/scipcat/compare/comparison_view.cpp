// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/compare/comparison_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/scipcat/compare/comparison_words.h"

namespace scipd::tools::comparing {
namespace {

Mark mark_of(const Difference& difference) {
    if (difference.what != What::mean) return Mark::otherwise;
    return difference.difference() < 0 ? Mark::nearer : Mark::farther;
}

double angle_of(const Comparison& comparison, std::size_t pair) {
    const sim::Directions& directions = comparison.a.directions;
    const double middle = (directions.cluster - 1) / 2.0 / directions.cluster;
    return *directions.first_rad +
           *directions.increment_rad * (static_cast<double>(comparison.pairs[pair].a) + middle);
}

/// How many times A's, or B's own where A has nothing.
std::string multiple_text(const Difference& difference, const char* times, const char* own) {
    const bool any = difference.a > 0;
    char text[60];
    std::snprintf(text, sizeof text, any ? times : own,
                  any ? difference.b / difference.a : difference.b);
    return text;
}

std::string short_text(const Difference& difference) {
    char text[60];
    const double by = difference.difference();
    const double size = std::abs(by);
    switch (difference.what) {
        case What::mean:
            std::snprintf(text, sizeof text, size < 100 ? "%+.0f mm" : "%+.2f m",
                          size < 100 ? by : by / 1e3);
            return text;
        case What::sd:
            return "noise" + multiple_text(difference, " × %.2g", " %.1f mm");
        case What::intensity:
            return "light" + multiple_text(difference, " × %.2g", " %.0f");
        default:
            return "codes";
    }
}

using Statistic = double BeamStatistics::*;

Curve curve_of(const Comparison& comparison, Statistic value) {
    Curve curve;
    for (const BeamPair& pair : comparison.pairs) {
        curve.a.push_back(comparison.a.beams[pair.a].*value);
        curve.b.push_back(comparison.b.beams[pair.b].*value);
    }
    return curve;
}

}  // namespace

std::vector<Mark> marks_of(const Comparison& comparison) {
    std::vector<Mark> marks(comparison.pairs.size(), Mark::alike);
    for (const Difference& difference : comparison.differ) {
        if (!difference.is_of_steps() || difference.what == What::neighbours) continue;
        for (std::size_t pair = difference.first_pair; pair <= difference.last_pair; ++pair) {
            if (marks[pair] == Mark::alike) marks[pair] = mark_of(difference);
        }
    }
    return marks;
}

std::vector<SeenPoint> points_of(const Comparison& comparison, bool of_a) {
    if (!comparison.a.directions.first_rad || !comparison.a.directions.increment_rad) return {};
    std::vector<SeenPoint> points;
    for (std::size_t pair = 0; pair < comparison.pairs.size(); ++pair) {
        const BeamPair& beams = comparison.pairs[pair];
        const BeamStatistics& beam =
            of_a ? comparison.a.beams[beams.a] : comparison.b.beams[beams.b];
        if (beam.share < 0.5) continue;
        const double range_m = (beam.median_mm + (of_a ? 0 : beams.nearer_mm)) / 1e3;
        const double angle_rad = angle_of(comparison, pair);
        points.push_back({range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), pair});
    }
    return points;
}

std::vector<RunLabel> labels_of(const Comparison& comparison) {
    constexpr std::size_t most = 8;
    const auto points = points_of(comparison, false);
    double reach_m = 0;
    for (const SeenPoint& point : points)
        reach_m = std::max({reach_m, std::abs(point.x_m), std::abs(point.y_m)});
    const double apart_m = 0.13 * reach_m;
    std::vector<RunLabel> labels;
    for (const Difference& difference : weightiest_first(comparison.differ)) {
        if (!difference.is_of_steps() || difference.what == What::neighbours) continue;
        const std::size_t middle = (difference.first_pair + difference.last_pair) / 2;
        const auto at = std::ranges::find_if(
            points, [&](const SeenPoint& point) { return point.pair >= middle; });
        if (at == points.end() || labels.size() == most) continue;
        const bool taken = std::ranges::any_of(labels, [&](const RunLabel& label) {
            return std::hypot(label.at.x_m - at->x_m, label.at.y_m - at->y_m) < apart_m;
        });
        if (!taken) labels.push_back({*at, mark_of(difference), short_text(difference)});
    }
    return labels;
}

Curve spreads_by_step(const Comparison& comparison) {
    return curve_of(comparison, &BeamStatistics::sd_mm);
}

Curve intensities_by_step(const Comparison& comparison) {
    return curve_of(comparison, &BeamStatistics::intensity);
}

double reach_of(const std::vector<double>& values) {
    constexpr double most = 0.9;
    std::vector<double> sizes;
    for (const double value : values) {
        if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
    const double reach = quantile_of(std::move(sizes), most);
    return reach > 0 ? 1.25 * reach : 1;
}

}  // namespace scipd::tools::comparing
