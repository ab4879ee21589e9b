// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is cast in one go: many directions, and one pose for all of them, one each, or one for every
// so many of them. A planar sweep, a camera's grid and a sonar's cone are all fans. A fan only
// views its arrays: whoever builds it keeps them alive until the cast returns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "sim/world/material.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// Models and objects that rays pass through.
struct Unseen {
    Unseen(ModelId body = no_model, std::span<const ObjectId> some = {})
        : model(body), objects(some) {}

    ModelId model;                      ///< a movable one: the body that carries the sensor
    std::span<const ObjectId> objects;  ///< of any model: the housing of the sensor

    [[nodiscard]] bool has(ObjectId object) const {
        return std::ranges::find(objects, object) != objects.end();
    }
};

struct Fan {
    /// Unit vectors in S. Neighbours in the array should be neighbours in space, since backends
    /// cast packets of them.
    std::span<const glm::vec3> directions;
    /// One for all directions, or one for each, or for each group of directions_per_pose.
    std::span<const Pose> world_from_sensor;
    /// Backends report nothing beyond.
    float max_range_m = std::numeric_limits<float>::infinity();
    Unseen unseen = {};
    /// The only movable models that any of the directions can meet. Backends need not look at the
    /// others. Nothing where nobody knows: they look at all.
    std::optional<std::span<const ModelId>> can_meet = std::nullopt;
    /// How many directions in a row share a pose, where there are several poses.
    std::size_t directions_per_pose = 1;

    [[nodiscard]] std::size_t pose_index(std::size_t direction) const {
        return world_from_sensor.size() == 1 ? 0 : direction / directions_per_pose;
    }
};

inline constexpr ObjectId no_object = std::numeric_limits<ObjectId>::max();

/// What one ray met first.
struct Hit {
    /// Along the ray, not a depth; infinity where nothing is met.
    float range_m = std::numeric_limits<float>::infinity();
    /// |cos| of the angle between the ray and the face's normal; 0 where nothing is met.
    float cos_incidence = 0.0F;
    MaterialId material = 0;
    ObjectId object = no_object;

    [[nodiscard]] bool met() const { return object != no_object; }
};

}  // namespace scipd::sim
