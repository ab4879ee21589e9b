// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The named frames of a model that libsdformat has read, without its links. Any thread; nothing
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

/// Where a model and its links lie. In a saved world this may differ from what their elements say.
struct ModelPlaces {
    Place model;
    std::map<std::string, Place> links;  ///< by their names in the model
};

/// The frames of a model called `name`. A frame that stands for a sensor of `found`
/// (offer_sensors()) carries that sensor. Frames that cannot be resolved are left out.
std::vector<Frame> frames_of(const sdf::Model& model, const ModelPlaces& places,
                             const std::string& name, const std::vector<FoundSensor>& found);

}  // namespace scipd::sim
