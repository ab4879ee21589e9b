// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/beam_cone.h"

#include <cmath>
#include <numbers>

namespace scipd::sim {

// The seeds of a sunflower (Vogel: A better way to construct the sunflower head, Mathematical
// Biosciences 44, 1979), on a cap instead of a disc: the area of a cap is as its height.
std::vector<glm::vec3> BeamCone::directions() const {
    constexpr double golden_angle_rad = std::numbers::pi * (3.0 - 2.23606797749978969);
    const double height = 1.0 - std::cos(0.5 * opening_rad);
    std::vector<glm::vec3> all;
    all.reserve(static_cast<std::size_t>(beams));
    for (int i = 0; i < beams; ++i) {
        const double depth = beams == 1 ? 0.0 : height * i / (beams - 1);
        const double aside = std::sqrt(depth * (2.0 - depth));
        const double turned_rad = golden_angle_rad * i;
        all.emplace_back(1.0 - depth, aside * std::cos(turned_rad), aside * std::sin(turned_rad));
    }
    return all;
}

}  // namespace scipd::sim
