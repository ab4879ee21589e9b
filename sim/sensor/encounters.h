// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// In which parts a sweep is cast while models move. A moving model meets only the few beams that
// are fired towards it. So before a whole sweep is cast, each model is placed where it is while
// those beams are fired. Only where a model moves more than a millimetre meanwhile, the sweep is
// cast in parts, and the model is placed anew for each. Each part lists the models that its beams
// can meet, which are few among many. Casts nothing itself. Pure.
//
// Where a backend can cast what moves after what stands still, each model is cast alone, for the
// beams that it may stand in front of: what lies behind a wall costs nothing then.
//
//      beams   0 ......................................... 1080
//      crate          |--|                                        placed once
//      person                        |-----------|                a long step: placed three times
//      parts   |--------------------------|----|---------------|
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sim/sensor/scan.h"
#include "sim/sensor/scanner.h"
#include "sim/sensor/sensor_motion.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"
#include "sim/world/mover.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// How far a model may move within a part. It moves half of that before and half after the instant
/// at which it is placed.
inline constexpr double moves_within_part_m = 1e-3;

/// A model is placed where it is at this time.
struct MoverUpdate {
    std::size_t mover = 0;  ///< index
    Time time{};
};

/// Beams that are cast in one go, once these models have been placed.
struct Part {
    Beams beams;
    std::vector<MoverUpdate> updates;
    std::vector<ModelId> can_meet;  ///< its beams meet no other movable model
};

/// Beams in front of which a model may stand that is placed where it is at this time.
struct Passing {
    std::size_t mover = 0;  ///< index
    Beams beams;
    Time time{};
};

/// When each model by itself passes in front of what the scan has met so far: models that no beam
/// reaches are left out. `sensor` moves as the poses of the scan say.
[[nodiscard]] std::vector<Passing> passings_of_sweep(
    const SensorSpec& optics, const SensorMotion& sensor, const Scan& scan,
    const std::function<Time(std::size_t beam)>& fired, std::span<const Mover> movers);

/// The parts of one sweep, in order. `world_from_sensor` is one pose or one for each beam; `fired`
/// tells when a beam is fired, counted from the first. The first part places all movers.
[[nodiscard]] std::vector<Part> parts_of_sweep(const SensorSpec& optics,
                                               std::span<const Pose> world_from_sensor,
                                               const std::function<Time(std::size_t beam)>& fired,
                                               std::span<const Mover> movers);

}  // namespace scipd::sim
