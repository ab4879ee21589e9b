// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
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

}  // namespace scipd::sim
