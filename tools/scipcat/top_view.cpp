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
using protocol::client::ScanRequest;

/// The directions of a scan's groups of steps.
class Directions {
  public:
    Directions(const ScanRequest& request, const Parameters& parameters)
        : request_(request), parameters_(parameters) {}

    [[nodiscard]] double step_rad() const {
        return request_.cluster * 2.0 * std::numbers::pi / parameters_.ares;
    }
    [[nodiscard]] bool is_distance(std::uint32_t value_mm) const {
        return parameters_.is_distance(value_mm);
    }
    [[nodiscard]] ViewPoint point(std::size_t group, int echo, std::uint32_t distance_mm) const {
        const double middle = (request_.cluster - 1) / 2.0;
        const double angle_rad = parameters_.angle_rad(request_.first_step + middle) +
                                 static_cast<double>(group) * step_rad();
        const double range_m = distance_mm / 1000.0;
        return {.x_m = range_m * std::cos(angle_rad),
                .y_m = range_m * std::sin(angle_rad),
                .range_m = range_m,
                .step = request_.first_step + static_cast<int>(group) * request_.cluster,
                .echo = echo};
    }

  private:
    const ScanRequest& request_;
    const Parameters& parameters_;
};

/// Two neighbours count as one surface if they are no farther apart than on a wall that the beam
/// hits at about 7 degrees. A constant is added for noise.
bool on_one_surface(const ViewPoint& a, const ViewPoint& b, double step_rad) {
    constexpr double grazing = 8.0;
    constexpr double noise_m = 0.02;
    const double spacing_m = std::min(a.range_m, b.range_m) * step_rad;
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < grazing * spacing_m + noise_m;
}

void add_first_echoes(TopView& view, const ScanMessage& scan, const Directions& directions) {
    bool adjacent = false;
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i) {
        if (!directions.is_distance(scan.distances_mm[i])) {
            adjacent = false;
            continue;
        }
        ViewPoint point = directions.point(i, 0, scan.distances_mm[i]);
        if (view.has_intensity) point.intensity = scan.intensities[i];
        point.adjacent = adjacent;
        point.joined = adjacent && on_one_surface(view.points.back(), point, directions.step_rad());
        view.points.push_back(point);
        adjacent = true;
    }
}

void add_further_echoes(TopView& view, const ScanMessage& scan, const Directions& directions) {
    for (std::size_t i = 0; i < scan.further_echoes.size(); ++i) {
        for (int echo = 1; const auto& [distance_mm, intensity] : scan.further_echoes[i]) {
            ViewPoint point = directions.point(i, echo++, distance_mm);
            point.intensity = intensity;
            if (directions.is_distance(distance_mm)) view.further.push_back(point);
        }
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

TopView make_top_view(const ScanMessage& scan, const Parameters& parameters) {
    TopView view{.directions = scan.distances_mm.size(),
                 .first_angle_rad = parameters.angle_rad(scan.request.first_step),
                 .last_angle_rad = parameters.angle_rad(scan.request.last_step),
                 .has_intensity = !scan.intensities.empty()};
    const Directions directions(scan.request, parameters);
    add_first_echoes(view, scan, directions);
    add_further_echoes(view, scan, directions);
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
