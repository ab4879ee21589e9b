// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the models that stand for actors (sdf_actor.h) and makes them walk. Any thread; nothing
// shared.
#pragma once

#include <vector>

#include <sdf/Model.hh>

#include "sim/loaders/sdf/sdf_actor.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// The actor that `model` stands for; null if it stands for none.
const SdfActor* actor_of(const sdf::Model& model, const std::vector<SdfActor>& actors);

/// `still` with the script of the actor, at the first pose of that script. Waypoints are poses in
/// the world, as in Gazebo Classic (gazebo/physics/Actor.cc sets them as world poses). If an
/// include puts the actor elsewhere, they are relative to that place, as in Gazebo Sim
/// (src/rendering/RenderUtil.cc).
Model walking(Model still, const SdfActor& actor, const sdf::Model& model);

}  // namespace scipd::sim
