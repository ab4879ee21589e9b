// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/beam_pattern.h"

#include <cmath>

namespace scipd::sim {

BeamPattern::BeamPattern(const SensorSpec& spec) {
    directions_.reserve(static_cast<std::size_t>(spec.beams()));
    for (int step = spec.first_step; step <= spec.last_step; ++step) {
        const double angle_rad = spec.angle_rad(step);
        directions_.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    }
}

}  // namespace scipd::sim
