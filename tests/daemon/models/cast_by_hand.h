// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner without a bias reads of a view whose geometry is closed-form: cast by hand, ray by
// ray, without a backend.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sim/sensor/echo_model.h"
#include "sim/sensor/scanner.h"

namespace scipd::daemon {

inline constexpr double degree = std::numbers::pi / 180.0;

/// A straight wall.
struct FlatWall {
    double range_m = 0.0;        ///< of the front beam
    double incidence_rad = 0.0;  ///< of the front beam

    [[nodiscard]] sim::Hit operator()(double bearing_rad) const {
        const double met_rad = incidence_rad + bearing_rad;
        const double met_m = range_m * std::cos(incidence_rad) / std::cos(met_rad);
        return {static_cast<float>(met_m), static_cast<float>(std::cos(met_rad)), 0, 0};
    }
};

struct How {
    sim::Accuracy accuracy = sim::Accuracy::sensor;
    sim::Surface surface{.diffuse = 1.0F};  ///< of all faces
    int aside = 20;                         ///< so many beams on either side of the front one
};

/// `view` says what a ray of a bearing meets.
template <class View>
sim::Scan scan_of(const View& view, sim::SensorSpec optics, std::int64_t revolution,
                  const How& how = {}) {
    optics.first_step = optics.front_step - how.aside;
    optics.last_step = optics.front_step + how.aside;
    const sim::ErrorModel errors{.accuracy = how.accuracy, .seed = 3, .sensor = 9};
    const bool lit = how.accuracy == sim::Accuracy::material;
    if (!lit) optics.footprint.rays = 1;
    const sim::BeamPattern pattern(optics);
    sim::Scan scan{.revolution = revolution, .world_from_sensor = {sim::Pose{}}};
    scan.rays_per_beam = pattern.rays_per_beam();
    scan.hits.resize(pattern.directions().size());
    for (std::size_t i = 0; i < scan.hits.size(); ++i) {
        const auto step = optics.first_step + static_cast<int>(i / scan.rays_per_beam);
        const double across = lit ? pattern.footprint()[i % scan.rays_per_beam].across : 0.0;
        scan.hits[i] = view(optics.angle_rad(step) + across * optics.footprint.half_width_rad);
    }
    if (lit) {
        const sim::LitWorld world(std::array{how.surface}, {});
        sim::find_echoes(scan, optics, pattern, world, errors.key(revolution));
    }
    errors.read(optics, sim::Conditions{}.on_for, scan);
    return scan;
}

}  // namespace scipd::daemon
