// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The shapes around a sensor: its own housing, and, as a mistake, something solid that it is inside
// of, or the ground above it. Looks at the shapes one by one, as the reference backend does, which
// takes a while in large worlds. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/backends/fan.h"
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

/// For a sensor at this point of W among models at these poses, by ModelId. What is unseen, the
/// body that carries the sensor or its housing, may be around it. A mesh is solid where it is
/// closed and its faces are turned outwards; a room that is a single mesh has them turned inwards.
std::optional<OddPlace> odd_place(const Scene& scene, std::span<const Pose> world_from_model,
                                  const glm::dvec3& at_m, const Unseen& unseen = {});

/// The objects of the model `carrier` that are the housing of a sensor at this pose in it: each
/// encloses the emitter, so that most of these directions, in S, meet it close by. `link` is the
/// name of the one that carries the sensor. Links rigidly joined to it often have the housing
/// instead: where this one has none, the closest housing of another link counts.
std::vector<ObjectId> housing_of(const Scene& scene, ModelId carrier, const std::string& link,
                                 const Pose& model_from_sensor,
                                 std::span<const glm::vec3> directions);

}  // namespace scipd::sim
