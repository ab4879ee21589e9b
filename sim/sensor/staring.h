// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sensors that stare instead of turning: a camera that measures ranges (a grid of pixels) and a
// ranger that makes one range of a whole cone. All their beams are of one instant. No wire. Lives
// on the thread of its backend.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/sensor/aggregation.h"
#include "sim/sensor/beam_cone.h"
#include "sim/sensor/pinhole_grid.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/scanner.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"

namespace scipd::sim {

struct RangerOptics {
    BeamCone cone;
    Aggregate aggregate = Aggregate::nearest;

    bool operator==(const RangerOptics&) const = default;
};

struct StaringSpec {
    std::variant<PinholeGrid, RangerOptics> optics;
    Time period{};
    /// What it reads below or above is nothing.
    double min_range_m = 0.0;
    double max_range_m = 0.0;
    std::vector<NoiseStep> noise;  ///< as of scanners

    bool operator==(const StaringSpec&) const = default;

    /// "camera" or "ranger".
    [[nodiscard]] std::string_view kind() const;
    [[nodiscard]] int beams() const;
    /// Of all beams, in S.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

class Staring {
  public:
    Staring(const StaringSpec& spec, const ErrorModel& errors);

    [[nodiscard]] const StaringSpec& spec() const { return spec_; }
    /// What casts its beams: they are what a scanner's steps are, from 0, and a turn is its period.
    [[nodiscard]] Scanner make_scanner() const;

    /// What it says of a measurement of that scanner: a range for each pixel, or one; infinity
    /// where that is nothing. A ranger's noise is that of the range that it tells, drawn once: as
    /// the least of many noisy ranges it would always be too short.
    [[nodiscard]] std::vector<float> read(const Scan& scan) const;

  private:
    StaringSpec spec_;
    ErrorModel errors_;
    SensorSpec steps_;
    std::optional<Aggregation> aggregation_;  ///< of a ranger
};

}  // namespace scipd::sim
