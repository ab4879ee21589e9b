// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/top_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scipd::tools {
namespace {

using protocol::client::Parameters;
using protocol::client::ScanMessage;

/// Two neighbours count as one surface if they are no farther apart than on a wall that the beam
/// hits at about 7 degrees. A constant is added for noise.
bool on_one_surface(const ViewPoint& a, const ViewPoint& b, double step_rad) {
    constexpr double grazing = 8.0;
    constexpr double noise_m = 0.02;
    const double spacing_m = std::min(a.range_m, b.range_m) * step_rad;
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < grazing * spacing_m + noise_m;
}

Bounds bounds_of(const std::vector<ViewPoint>& points) {
    constexpr double least_m = 0.5;
    constexpr double margin = 0.04;
    Bounds bounds;
    for (const ViewPoint& point : points)
        bounds.include(point.x_m, point.y_m);
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

TopView make_top_view(const ScanMessage& scan, const Parameters& parameters) {
    const auto& request = scan.request;
    const auto angle_of = [&](std::size_t group) {
        const double middle = (request.cluster - 1) / 2.0;
        return parameters.angle_rad(request.first_step + middle) +
               static_cast<double>(group) * request.cluster * 2.0 * std::numbers::pi /
                   parameters.ares;
    };
    const double step_rad = angle_of(1) - angle_of(0);

    TopView view{.directions = scan.distances_mm.size(),
                 .first_angle_rad = parameters.angle_rad(request.first_step),
                 .last_angle_rad = parameters.angle_rad(request.last_step),
                 .has_intensity = !scan.intensities.empty()};
    bool adjacent = false;
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i) {
        const std::uint32_t distance_mm = scan.distances_mm[i];
        if (!parameters.is_distance(distance_mm)) {
            adjacent = false;
            continue;
        }
        const double range_m = distance_mm / 1000.0;
        ViewPoint point{.x_m = range_m * std::cos(angle_of(i)),
                        .y_m = range_m * std::sin(angle_of(i)),
                        .range_m = range_m,
                        .intensity = view.has_intensity ? scan.intensities[i] : 0,
                        .adjacent = adjacent};
        point.joined = adjacent && on_one_surface(view.points.back(), point, step_rad);
        view.points.push_back(point);
        adjacent = true;
    }
    view.bounds = bounds_of(view.points);
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
