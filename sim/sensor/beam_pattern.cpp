// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/beam_pattern.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace scipd::sim {
namespace {

/// The tangent of the middle of pixel i of so many; that of the first one is the greatest.
double tangent(int i, int count, double angle_rad) {
    return std::tan(0.5 * angle_rad) * (count - 1 - 2 * i) / count;
}

}  // namespace

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

std::vector<glm::vec3> PinholeGrid::directions() const {
    std::vector<glm::vec3> all;
    all.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
        const double up = tangent(row, rows, height_rad);
        for (int column = 0; column < columns; ++column)
            all.emplace_back(
                glm::normalize(glm::dvec3{1.0, tangent(column, columns, width_rad), up}));
    }
    return all;
}

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
