// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The named places of a model that libsdformat has read, but for its links. Any thread; nothing
// shared.
#pragma once

#include <vector>

#include <sdf/Model.hh>

#include "sim/loaders/sdf/sdf_place.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Its frames, and those that stand for a sensor of `found` (offer_sensors()) as such. The model
/// lies at `place` and is called `name`. What cannot be resolved is not among them.
std::vector<Frame> frames_of(const sdf::Model& model, const Place& place, const std::string& name,
                             const std::vector<FoundSensor>& found);

}  // namespace scipd::sim
