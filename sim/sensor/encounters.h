// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What moves meets only a few beams of a sweep, those that are fired towards it. So the models are
// put where they are at that moment, each by itself, before a sweep is cast in one go; only where
// one moves more than a millimetre while beams may meet it, the sweep is cast in parts. Among many
// models each part can meet few. Casts nothing itself. Pure.
//
//      beams   0 ......................................... 1080
//      crate          |--|                                        one put
//      person                        |-----------|                a long step: three
//      parts   |--------------------------|----|---------------|
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sim/sensor/scanner.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/time.h"
#include "sim/world/mover.h"
#include "sim/world/pose.h"

namespace scipd::sim {

/// What a model may move within a part: half of it before it is where it has been put.
inline constexpr double moves_within_part_m = 1e-3;

/// A model is put where it is at that time.
struct Put {
    std::size_t mover = 0;  ///< index
    Time time{};
};

/// Beams that are cast in one go, once these have been put.
struct Part {
    Beams beams;
    std::vector<Put> puts;
    std::vector<ModelId> can_meet;  ///< nothing else that moves
};

/// The parts of one sweep, in order. `world_from_sensor` is one pose or one for each beam; `fired`
/// tells when a beam is, counted from the first. All movers are put before the first part.
[[nodiscard]] std::vector<Part> parts_of_sweep(const SensorSpec& optics,
                                               std::span<const Pose> world_from_sensor,
                                               const std::function<Time(std::size_t beam)>& fired,
                                               std::span<const Mover> movers);

}  // namespace scipd::sim
