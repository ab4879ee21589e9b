// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns what the rays of a footprint met into the echoes that come back from it. Knows the world's
// materials and its air, but not how good the sensor is: that is ErrorModel. Pure.
#pragma once

#include <cstdint>
#include <span>

#include "sim/random.h"
#include "sim/sensor/beam_pattern.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"
#include "sim/world/lit_world.h"

namespace scipd::sim {

/// Fills scan.echoes for a world that looks like this. Faces that lie closer behind each other than
/// half a pulse are one echo, at the mean of their ranges, each weighted by the light that it
/// sends. `key`: of the run and the sensor; its purpose does not matter.
void find_echoes(Scan& scan, const SensorSpec& spec, const BeamPattern& pattern,
                 const LitWorld& lit, ChanceKey key);

}  // namespace scipd::sim
