// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Models that were actors before libsdformat read them (sdf_actor.h). Any thread; nothing shared.
#pragma once

#include <vector>

#include <sdf/Model.hh>

#include "sim/loaders/sdf/sdf_actor.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Null where it was none of these.
const SdfActor* actor_of(const sdf::Model& model, const std::vector<SdfActor>& actors);

/// The model as it walks, which begins where its script does. Waypoints are in the world, as in
/// Gazebo Classic (gazebo/physics/Actor.cc sets them as world poses), unless an include puts the
/// actor elsewhere: then they are told from there, as in Gazebo Sim (src/rendering/RenderUtil.cc).
Model walking(Model still, const SdfActor& actor, const sdf::Model& model);

}  // namespace scipd::sim
