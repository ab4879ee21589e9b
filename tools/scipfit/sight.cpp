// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/sight.h"

#include <cmath>

namespace scipd::tools {

double FaceLine::range_mm(const FlatPose& place, double direction_rad) const {
    const double ahead_mm =
        distance_mm - std::cos(normal_rad) * place.x_mm - std::sin(normal_rad) * place.y_mm;
    return ahead_mm / std::cos(direction_rad - normal_rad);
}

std::vector<Sight> sights_of(const Standing& standing, std::size_t station) {
    constexpr double steepest = 2.1;
    const ScanTable& readings = *standing.readings;
    const std::vector<Beam>& beams = standing.stations[station].beams;
    std::vector<Sight> sights;
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const Beam& beam = beams[i];
        if (!beam.inside || std::abs(beam.slope_mm) > steepest * beam.mean_mm * readings.beam_rad())
            continue;
        const double deviation_mm = std::sqrt(beam.variance_mm2 / static_cast<double>(beam.count));
        sights.push_back(
            {station, i, readings.angle_rad(i), beam.mean_mm, deviation_mm, beam.intensity, 0, 0});
    }
    return sights;
}

}  // namespace scipd::tools
