// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner sees of an actor: its skin in the pose that the file gives it, or a capsule
// instead. Any thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/resources/resources.h"
#include "sim/world/bounds.h"

namespace scipd::sim {

struct ActorSkin {
    std::vector<SharedPart> parts;
    double lift_m = 0.0;  ///< above the actor's origin
    std::string warning;  ///< for example, why a capsule replaces it; empty: none
};

/// The skin of an actor whose origin is at `actor_z_m`. Throws LoadError if the world already has
/// too many triangles for any skin.
ActorSkin skin_of(const NamedFile& file, const MeshView& view, const Resources& resources,
                  MeshShelf& shelf, double actor_z_m);

/// How far to lift a skin so that either its feet or its hips are at the actor's height, whichever
/// brings the feet closer to z = 0.
///
/// Gazebo Classic adds the root of the animation, which is at hip height, to each waypoint, so
/// people write z = 0 (gazebo/physics/Actor.cc, Update). Gazebo Sim does not add it, and neither
/// Gazebo adds it where a plugin moves the actor, so people write z = 1
/// (src/rendering/SceneManager.cc, ActorAnimationAt).
double lift_m(const Bounds& skin, double actor_z_m);

}  // namespace scipd::sim
