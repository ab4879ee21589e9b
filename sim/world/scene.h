// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is there: models, the objects that they consist of, and materials, as flat tables that refer
// to each other by index. A scene is immutable once loaded and shared by everyone who looks at it;
// where its movable models are at present is kept by whoever moves them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/material.h"
#include "sim/world/pose.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// Index into Scene::objects.
using ObjectId = std::uint32_t;
/// Index into Scene::models.
using ModelId = std::uint32_t;
inline constexpr ModelId no_model = std::numeric_limits<ModelId>::max();

/// What moves as one body.
struct Model {
    std::string name;
    bool movable = false;
    Pose world_from_model;  ///< at load
};

/// One piece of geometry of one material.
struct Object {
    std::string name;  ///< MODEL::LINK::VISUAL
    ModelId model = 0;
    Pose model_from_object;
    Shape shape;
    MaterialId material = 0;
};

struct Scene {
    std::string name;
    std::vector<Model> models;
    std::vector<Object> objects;
    std::vector<Material> materials{{"default"}};

    /// A point of W near the middle of everything. Backends work in float relative to it, so that a
    /// world that lies 10 km from its origin is as exact as one around it.
    glm::dvec3 anchor_m{0.0, 0.0, 0.0};

    /// Of all objects at load, in W; used to place the anchor.
    static glm::dvec3 middle_of(const Scene& scene);
};

using SharedScene = std::shared_ptr<const Scene>;

}  // namespace scipd::sim
