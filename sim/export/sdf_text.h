// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world as an SDF text: each model with its shapes, which stay as exact as they are, and its
// materials, as docs/materials.md has them. Meshes are in files beside it, which somebody else
// writes. Sensors, joints and the walks of actors are left out: who walks stands where it is. Any
// thread; nothing shared.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Where the mesh of an object will be, relative to the SDF.
using MeshUri = std::function<std::string(ObjectId)>;

/// The models are at these poses, by ModelId.
std::string sdf_of(const Scene& scene, std::span<const Pose> world_from_model, const MeshUri& uri);

}  // namespace scipd::sim
