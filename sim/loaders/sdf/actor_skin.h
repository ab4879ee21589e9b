// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is seen of an actor: its skin, as it stands in its file, or what is put in its place. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sdf/Mesh.hh>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/world/bounds.h"

namespace scipd::sim {

struct ActorSkin {
    std::vector<SharedPart> parts;
    double lift_m = 0.0;  ///< from the actor's origin
    std::string warning;  ///< why a capsule stands in for it, say; empty: none
};

/// Of an actor at this height; `folder` is that of the file that names the skin. Throws LoadError
/// where the world has too many triangles for any.
ActorSkin skin_of(const sdf::Mesh& mesh, const std::filesystem::path& folder,
                  const Resources& resources, MeshShelf& shelf, double actor_z_m);

/// By how much a skin is lifted: its feet come to stand at the actor's height or its hips,
/// whichever brings the feet closer to z = 0.
///
/// In Gazebo Classic the animation's root, which is as high as the hips are, is added to a
/// waypoint, and people write z = 0 (gazebo/physics/Actor.cc, Update). In Gazebo Sim, and where a
/// plugin moves the actor, it is not, and they write z = 1 (src/rendering/SceneManager.cc,
/// ActorAnimationAt).
double lift_m(const Bounds& skin, double actor_z_m);

}  // namespace scipd::sim
