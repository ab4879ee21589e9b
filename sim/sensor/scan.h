// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One revolution as the sensor saw it, stage by stage: what its rays met, the echoes that came back
// from there, and what the sensor read. It never changes once it is measured, and is shared by
// everyone who sends or inspects it. Any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/backends/fan.h"
#include "sim/sensor/echo.h"
#include "sim/sensor/per_beam.h"
#include "sim/sensor/reading.h"
#include "sim/time.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// What a ray meets behind a transparent face or in a mirror.
struct FartherHit {
    std::uint32_t ray = 0;  ///< index into the hits
    float share = 0.0F;     ///< of the light, there and back
    Hit hit;                ///< its range is that of the whole way
    glm::dvec3 at_m{0.0};   ///< where, in W
};

struct Scan {
    std::int64_t revolution = 0;
    Time start{};                         ///< the instant of step 0
    std::vector<Pose> world_from_sensor;  ///< one, or one per beam
    std::vector<Time> posed_at;           ///< when it was at these poses; empty: unknown
    std::size_t rays_per_beam = 1;
    /// What the rays met: those of the beam of first_step, the middle one first, then the next
    /// beam.
    std::vector<Hit> hits;
    std::vector<FartherHit> farther;     ///< by growing ray
    std::vector<std::uint32_t> dazzled;  ///< the beams that another scanner's light disturbs
    PerBeam<Echo> echoes;                ///< near to far
    std::vector<Reading> readings;       ///< one per beam: what a reply with single echoes tells
    PerBeam<Reading> every_echo;         ///< near to far, of sensors that tell several echoes

    [[nodiscard]] std::size_t beams() const { return hits.size() / rays_per_beam; }
    /// What the middle of a beam met: the truth about its range.
    [[nodiscard]] const Hit& middle(std::size_t beam) const { return hits[beam * rays_per_beam]; }
};

using SharedScan = std::shared_ptr<const Scan>;

}  // namespace scipd::sim
