// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/sensor/sensor_spec.h"

namespace scipd::sim {

/// The directions of a sensor's beams in S, in step order from first_step on. Computed once per
/// sensor.
class BeamPattern {
  public:
    explicit BeamPattern(const SensorSpec& spec);
    /// Of a sensor that does not turn: a direction a step, unit vectors.
    explicit BeamPattern(std::vector<glm::vec3> directions) : directions_(std::move(directions)) {}
    [[nodiscard]] std::span<const glm::vec3> directions() const { return directions_; }

  private:
    std::vector<glm::vec3> directions_;
};

}  // namespace scipd::sim
