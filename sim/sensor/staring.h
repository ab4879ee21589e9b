// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sensors that do not turn: a camera that measures ranges, which is a grid of pixels, and a ranger,
// which makes one range of a whole cone of beams. All their beams are cast at one instant. They
// have no wire. Lives on the thread of its backend.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/sensor/aggregation.h"
#include "sim/sensor/beam_pattern.h"
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
    /// A range below or above these is read as nothing.
    double min_range_m = 0.0;
    double max_range_m = 0.0;
    std::vector<NoiseStep> noise;  ///< as of scanners

    bool operator==(const StaringSpec&) const = default;

    /// "camera" or "ranger".
    [[nodiscard]] std::string_view kind() const;
    [[nodiscard]] int beams() const;
    /// The directions of all beams, in S.
    [[nodiscard]] std::vector<glm::vec3> directions() const;
};

class Staring {
  public:
    Staring(const StaringSpec& spec, const ErrorModel& errors);

    [[nodiscard]] const StaringSpec& spec() const { return spec_; }
    /// Makes the scanner that casts its beams: each beam is a step, from 0 on, and a turn takes one
    /// period.
    [[nodiscard]] Scanner make_scanner() const;

    /// Reads a measurement of that scanner: a range for each pixel of a camera, one range for a
    /// ranger, and infinity where nothing is met. A ranger's range gets noise once, after it has
    /// been chosen: the least of many noisy ranges would always be too short.
    [[nodiscard]] std::vector<float> read(const Scan& scan) const;

  private:
    [[nodiscard]] float read_one(const Scan& scan) const;
    [[nodiscard]] static std::vector<float> read_all(const Scan& scan);

    StaringSpec spec_;
    ErrorModel errors_;
    SensorSpec steps_;
    std::optional<Aggregation> aggregation_;  ///< of a ranger
};

}  // namespace scipd::sim
