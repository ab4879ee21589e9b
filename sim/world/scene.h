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
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/world/lidar.h"
#include "sim/world/material.h"
#include "sim/world/pose.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// Index into Scene::objects.
using ObjectId = std::uint32_t;
/// Index into Scene::models.
using ModelId = std::uint32_t;
inline constexpr ModelId no_model = std::numeric_limits<ModelId>::max();

struct Script;  // script.h
using SharedScript = std::shared_ptr<const Script>;

/// What moves as one body. Names differ within a scene; one that lies in another begins with its
/// name: OUTER::INNER.
struct Model {
    std::string name;
    bool movable = false;
    Pose world_from_model;          ///< at load
    SharedScript script = nullptr;  ///< null: it moves only as it is told to
};

/// One piece of geometry of one material.
struct Object {
    std::string name;  ///< MODEL::LINK::VISUAL
    ModelId model = 0;
    Pose model_from_object;
    Shape shape;
    MaterialId material = 0;
};

/// A place in a model that its file gives a name, where a sensor may be mounted: a link, a frame,
/// or where the file has a sensor of its own.
struct Frame {
    std::string name;  ///< MODEL::LINK, MODEL::FRAME, MODEL::LINK::SENSOR
    ModelId model = 0;
    Pose model_from_frame;
    std::string sensor;          ///< its type, such as gpu_lidar; empty: none is there
    std::optional<Lidar> lidar;  ///< where the sensor is one
};

struct Scene {
    std::string name;
    std::vector<Model> models;
    std::vector<Object> objects;
    std::vector<Frame> frames;
    std::vector<Material> materials{{"default"}};

    /// A point of W near the middle of most things (anchor.h). Backends work in float relative to
    /// it, so that a world that lies 10 km from its origin is as exact as one around it.
    glm::dvec3 anchor_m{0.0, 0.0, 0.0};
};

using SharedScene = std::shared_ptr<const Scene>;

/// Where the material is in a scene's list, to which it is added if it is not there. One without a
/// name is named like the first.
MaterialId id_of(Material material, std::vector<Material>& materials);

/// Nothing where there is no model of this name.
std::optional<ModelId> find_model(const Scene& scene, std::string_view name);

// A scene that somebody holds never changes; these make another one, which shares all meshes with
// it. It keeps the anchor, so that what both have in common stays the same to the last bit; only
// one without objects takes that of the first that come.

/// The scene and all models of `added`, none of whose names it may have. What was there keeps its
/// ids; models, objects and materials that are new follow in their order.
SharedScene with_models(const Scene& scene, const Scene& added);

/// What its ids mean, without the memory that its shapes take: names, models and materials stay,
/// and every shape is an empty mesh.
SharedScene without_shapes(const Scene& scene);

/// The scene less this model and all that lie in it (NAME::...). What stays keeps its order and
/// closes the gaps, so that ids behind the first gap are others now: look models up by name.
/// Null where there is no such model.
SharedScene without_model(const Scene& scene, std::string_view name);

/// Forgets the materials that no object is of and that are no more than a name, so that a world
/// which is changed for days does not collect names. Ids behind the first gap are others then.
void drop_unused_names(Scene& scene);

}  // namespace scipd::sim
