// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells whether a sensor is where nobody can want it: inside something solid or below the ground.
// Looks at the shapes one by one, as the reference backend does, which takes a while in large
// worlds. Pure; any thread.
#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "sim/world/scene.h"

namespace scipd::sim {

struct OddPlace {
    enum class Kind {
        inside,  ///< in all directions it sees backs of the object's faces
        below,   ///< the object is the ground, and nothing lies below the sensor
    };
    Kind kind;
    ObjectId object;
};

/// For a sensor at this point of W among models at these poses, by ModelId. The model `body`
/// carries the sensor, and may be around it. A mesh is solid where it is closed and its faces are
/// turned outwards; a room that is a single mesh has them turned inwards.
std::optional<OddPlace> odd_place(const Scene& scene, std::span<const Pose> world_from_model,
                                  const glm::dvec3& at_m, ModelId body = no_model);

}  // namespace scipd::sim
