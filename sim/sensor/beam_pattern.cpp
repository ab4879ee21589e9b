// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/beam_pattern.h"

#include <cmath>

namespace scipd::sim {

BeamPattern::BeamPattern(const SensorSpec& spec) : footprint_(footprint_rays(spec.footprint.rays)) {
    directions_.reserve(static_cast<std::size_t>(spec.beams()) * rays_per_beam());
    for (int step = spec.first_step; step <= spec.last_step; ++step) {
        for (const FootprintRay& ray : footprint_) {
            const double azimuth_rad =
                spec.angle_rad(step) + ray.across * spec.footprint.half_width_rad;
            const double up_rad = ray.up * spec.footprint.half_height_rad;
            directions_.emplace_back(std::cos(up_rad) * std::cos(azimuth_rad),
                                     std::cos(up_rad) * std::sin(azimuth_rad), std::sin(up_rad));
        }
    }
}

}  // namespace scipd::sim
