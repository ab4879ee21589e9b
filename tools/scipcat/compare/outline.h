// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner sees in the middle of all its scans, as points with the lines that they lie on. In
// its own frame: x forward, y left. A value; any thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/recording/values/recorded_scan.h"
#include "tools/analysis/beam_statistics.h"

namespace scipd::tools::comparing {

/// The points p with normal · p = distance_mm.
struct WallLine {
    glm::dvec2 normal{};
    double distance_mm = 0;
};

struct Outline {
    double first_rad = 0;
    double increment_rad = 0;
    std::vector<double> ranges_mm;  ///< medians; NaN where a beam mostly gives none
    /// What the neighbours of a beam lie on; none beside edges, on what is rough, or where the beam
    /// only grazes it.
    std::vector<std::optional<WallLine>> lines;

    [[nodiscard]] double angle_rad(std::size_t beam) const {
        return first_rad + increment_rad * static_cast<double>(beam);
    }
    [[nodiscard]] glm::dvec2 point_mm(std::size_t beam) const;
    /// The beam that looks there; none outside of the view.
    [[nodiscard]] std::optional<std::size_t> beam_at(double angle_rad) const;
};

/// Counter-clockwise from x.
[[nodiscard]] glm::dvec2 direction_at(double angle_rad);
[[nodiscard]] double bearing_of(glm::dvec2 point);
/// How far it is along this direction to the line.
[[nodiscard]] double range_to(const WallLine& line, double angle_rad);

/// None if the directions are not known.
[[nodiscard]] std::optional<Outline> outline_of(const sim::Directions& directions,
                                                std::span<const BeamStatistics> beams);

}  // namespace scipd::tools::comparing
