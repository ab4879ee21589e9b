// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner without a wire: optics, beams, a way to cast them and an error model. Knows nothing of
// when to measure or for whom. Lives on the thread of its backend.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/backends/range_backend.h"
#include "sim/sensor/beam_pattern.h"
#include "sim/sensor/error_model.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/scan_timing.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/sensor/spec_curves.h"
#include "sim/world/lit_world.h"

namespace scipd::sim {

/// Some beams that follow each other.
struct Beams {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// What else decides what a scanner reads.
struct Conditions {
    /// How the world looks to it; null only for scanners that do not see light.
    const LitWorld* lit = nullptr;
    /// Since when it is switched on.
    Time on_for = std::chrono::hours(24);
};

class Scanner {
  public:
    Scanner(SensorSpec spec, const ErrorModel& errors);
    /// `pattern`: a direction for each step that `spec` measures.
    Scanner(SensorSpec spec, BeamPattern pattern, const ErrorModel& errors);

    [[nodiscard]] const SensorSpec& spec() const { return spec_; }

    /// All its rays in S, those of a beam's footprint side by side.
    [[nodiscard]] std::span<const glm::vec3> directions() const { return pattern_.directions(); }
    [[nodiscard]] Accuracy accuracy() const { return errors_.accuracy; }
    /// Whether it needs to know how the world looks: at Accuracy::material.
    [[nodiscard]] bool sees_light() const { return errors_.accuracy == Accuracy::material; }

    /// Casts one revolution. `world_from_sensor` holds one pose for the whole sweep or one for each
    /// beam.
    [[nodiscard]] SharedScan measure(RangeBackend& backend, std::int64_t revolution, Time start,
                                     std::vector<Pose> world_from_sensor,
                                     const Conditions& conditions = {}) const;

    /// Makes a scan in pieces, for a world that moves meanwhile: call begin(), then cast() for some
    /// beams after the other, then read(). Beams that are not cast meet nothing.
    [[nodiscard]] Scan begin(std::int64_t revolution, Time start,
                             std::vector<Pose> world_from_sensor) const;
    /// `beams` are counted from the first one. For `unseen` and `can_meet` see Fan.
    void cast(RangeBackend& backend, Scan& scan, Beams beams, const Conditions& conditions,
              const Unseen& unseen = {},
              std::optional<std::span<const ModelId>> can_meet = std::nullopt) const;
    /// Whether the light goes on behind what these rays meet first.
    [[nodiscard]] bool follows_light(const RangeBackend& backend,
                                     const Conditions& conditions) const;
    /// Casts one movable model in front of what beams have met. For backends that cast apart, where
    /// no light is followed.
    void cast_moving(RangeBackend& backend, Scan& scan, Beams beams, ModelId model,
                     const Unseen& unseen = {}) const;
    void read(Scan& scan, const Conditions& conditions) const;

  private:
    /// The fan of these beams, and their hits.
    [[nodiscard]] Fan fan_of(const Scan& scan, Beams beams) const;
    [[nodiscard]] std::span<Hit> hits_of(Scan& scan, Beams beams) const;

    SensorSpec spec_;
    SpecCurves curves_;
    BeamPattern pattern_;
    ErrorModel errors_;
};

}  // namespace scipd::sim
