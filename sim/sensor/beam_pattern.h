// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The directions of a sensor's rays: of a scanner, with the footprint of each beam; of a camera,
// which looks along +x of S; and of an ultrasonic or infrared ranger, which fills a cone around +x
// evenly. Values; any thread.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/sensor/footprint.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// The directions of a sensor's rays in S, in step order from first_step on: all rays of one beam's
/// footprint, the middle one first, then those of the next. Computed once per sensor.
class BeamPattern {
  public:
    explicit BeamPattern(const SensorSpec& spec);
    /// For a sensor that does not turn: a direction a step, unit vectors.
    explicit BeamPattern(std::vector<glm::vec3> directions) : directions_(std::move(directions)) {}
    [[nodiscard]] std::span<const glm::vec3> directions() const { return directions_; }
    [[nodiscard]] std::span<const FootprintRay> footprint() const { return footprint_; }
    [[nodiscard]] std::size_t rays_per_beam() const { return footprint_.size(); }

  private:
    std::vector<glm::vec3> directions_;
    std::span<const FootprintRay> footprint_ = footprint_rays(1);
};

struct PinholeGrid {
    int columns = 0;
    int rows = 0;
    /// From edge to edge of the outermost pixels, each below pi.
    double width_rad = 0.0;
    double height_rad = 0.0;

    bool operator==(const PinholeGrid&) const = default;

    /// Through the middle of each pixel, in S: row by row, the first row on top, each from the
    /// left. Unit vectors.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

struct BeamCone {
    double opening_rad = 0.0;  ///< all of it, up to pi
    int beams = 0;

    bool operator==(const BeamCone&) const = default;

    /// In S, unit vectors: the first on the axis, the last at the rim, each with as much of the
    /// solid angle as any other.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

}  // namespace scipd::sim
