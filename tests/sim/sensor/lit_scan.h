// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scan in a small world that is cast for real, with the materials that a test gives: for tests of
// what light does.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/backends/registry.h"
#include "sim/sensor/scanner.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {

/// 41 beams, a degree apart, the middle one along x; beams of the width that a test gives it.
inline SensorSpec small_scanner(double half_width_rad, int rays = 7) {
    return {.steps_per_turn = 360,
            .first_step = 0,
            .last_step = 40,
            .front_step = 20,
            .scan_period = std::chrono::milliseconds(25),
            .max_range_m = 60.0,
            .footprint = {half_width_rad, half_width_rad, rays}};
}

inline constexpr std::size_t front_beam = 20;

inline const Surface white{.diffuse = 1.0F};

/// What such a scanner sees from the origin of W.
inline SharedScan lit_scan(std::string_view backend, const SharedScene& scene,
                           const std::vector<Surface>& surfaces, const SensorSpec& spec,
                           const std::vector<Medium>& media = {}, std::int64_t revolution = 0) {
    const LitWorld lit(surfaces, media);
    ErrorModel errors{.accuracy = Accuracy::material, .seed = 7, .sensor = 3};
    errors.tells_every_echo = true;
    const Scanner scanner(spec, errors);
    const auto made = find_backend(backend)->make(scene, {});
    return scanner.measure(*made, revolution, {}, {Pose{}}, {.lit = &lit});
}

/// Across x, so far away.
inline Pose ahead(double x_m, double y_m = 0.0) {
    return pose_from_rpy({x_m, y_m, 0.0}, {0.0, 0.0, 0.0});
}

}  // namespace scipd::sim
