// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/top_view.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace scipd::tools {
namespace {

using sim::RecordedScan;
using sim::ScannerIdentity;

/// The angle from one value to the next.
double increment_rad(const RecordedScan& scan) {
    return *scan.directions.increment_rad;
}
double step_rad(const RecordedScan& scan) {
    return increment_rad(scan) / scan.directions.cluster;
}

/// The point of a distance, in the middle of its group of steps.
ViewPoint point_of(const RecordedScan& scan, std::size_t group, double range_m) {
    const int cluster = scan.directions.cluster;
    const double angle_rad = *scan.directions.first_rad + (cluster - 1) / 2.0 * step_rad(scan) +
                             static_cast<double>(group) * increment_rad(scan);
    return {.x_m = range_m * std::cos(angle_rad),
            .y_m = range_m * std::sin(angle_rad),
            .range_m = range_m,
            .step = scan.directions.first_step.value_or(0) + static_cast<int>(group) * cluster};
}

/// Two neighbours count as one surface if they are no farther apart than on a wall that the beam
/// hits at about 7 degrees. A constant is added for noise.
bool on_one_surface(const ViewPoint& a, const ViewPoint& b, double step_rad) {
    constexpr double grazing = 8.0;
    constexpr double noise_m = 0.02;
    const double spacing_m = std::min(a.range_m, b.range_m) * step_rad;
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < grazing * spacing_m + noise_m;
}

std::uint32_t intensity_of(std::span<const double> intensities, std::size_t echo) {
    if (intensities.empty()) return 0;
    return static_cast<std::uint32_t>(std::clamp(intensities[echo], 0.0, 4e9));
}

void add_points(TopView& view, const RecordedScan& scan, const ScannerIdentity& identity) {
    bool adjacent = false;
    for (std::size_t i = 0; i < scan.steps(); ++i) {
        const auto ranges = scan.ranges_of(i);
        const auto intensities = scan.intensities_of(i);
        bool has_first = false;
        for (std::size_t echo = 0; echo < ranges.size(); ++echo) {
            const auto reading = sim::reading_of(ranges[echo], scan.unit, identity);
            if (reading.kind != sim::RecordedReading::Kind::distance) continue;
            ViewPoint point = point_of(scan, i, reading.range_m);
            point.echo = static_cast<int>(echo);
            point.intensity = intensity_of(intensities, echo);
            if (echo > 0) {
                view.further.push_back(point);
                continue;
            }
            has_first = true;
            point.adjacent = adjacent;
            point.joined =
                adjacent && on_one_surface(view.points.back(), point, increment_rad(scan));
            view.points.push_back(point);
        }
        adjacent = has_first;
    }
}

Bounds bounds_of(const TopView& view) {
    constexpr double least_m = 0.5;
    constexpr double margin = 0.04;
    Bounds bounds;
    for (const auto* const points : {&view.points, &view.further}) {
        for (const ViewPoint& point : *points)
            bounds.include(point.x_m, point.y_m);
    }
    bounds.widen(std::max(least_m, margin * std::max(bounds.width_m(), bounds.height_m())));
    return bounds;
}

}  // namespace

void Bounds::include(double x_m, double y_m) {
    min_x_m = std::min(min_x_m, x_m);
    max_x_m = std::max(max_x_m, x_m);
    min_y_m = std::min(min_y_m, y_m);
    max_y_m = std::max(max_y_m, y_m);
}

void Bounds::widen(double margin_m) {
    min_x_m -= margin_m;
    max_x_m += margin_m;
    min_y_m -= margin_m;
    max_y_m += margin_m;
}

TopView make_top_view(const RecordedScan& scan, const ScannerIdentity& identity) {
    const double first_rad = *scan.directions.first_rad;
    const double all_rad = static_cast<double>(scan.steps()) * increment_rad(scan);
    TopView view{.directions = scan.steps(),
                 .first_angle_rad = first_rad,
                 .last_angle_rad = first_rad + all_rad - step_rad(scan),
                 .has_intensity = !scan.intensities.empty()};
    add_points(view, scan, identity);
    view.bounds = bounds_of(view);
    return view;
}

double round_step_m(double length_m, double most) {
    const double least = length_m / most;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least) return factor * power;
    }
    return 10.0 * power;
}

}  // namespace scipd::tools
