// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The named places of a model that libsdformat has read, but for its links. Any thread; nothing
// shared.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <sdf/Model.hh>

#include "sim/loaders/sdf/sdf_place.h"
#include "sim/loaders/sdf/sdf_sensors.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Where a model and its links lie, which a saved world may have elsewhere than their elements say.
struct ModelPlaces {
    Place model;
    std::map<std::string, Place> links;  ///< by their names in the model
};

/// Its frames, and those that stand for a sensor of `found` (offer_sensors()) as such. The model is
/// called `name`. What cannot be resolved is not among them.
std::vector<Frame> frames_of(const sdf::Model& model, const ModelPlaces& places,
                             const std::string& name, const std::vector<FoundSensor>& found);

}  // namespace scipd::sim
