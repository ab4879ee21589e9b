// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What can move in a scene, as Embree searches it: either all models that a fan can meet at once,
// by a scene of their instances, or one after the other. Of one backend, and so of one thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sim/backends/embree_api.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// The geometry of movable models, as Embree searches it. Models of equal geometry share one body,
/// as robots of one kind do: it takes memory once, and stays in the caches. Lives with its device.
class EmbreeBodies {
  public:
    EmbreeBodies() = default;
    /// The bodies of all movable models of the scene.
    EmbreeBodies(RTCDevice device, const Scene& scene);

    /// In the frame of the model. Null: it does not move, or has no objects.
    [[nodiscard]] RTCScene of(ModelId model) const { return by_model_[model].scene; }

    /// Embree numbers the geometries of a body from 0.
    [[nodiscard]] ObjectId object(ModelId model, unsigned geometry) const {
        return by_model_[model].objects[geometry];
    }

  private:
    struct Body {
        RTCScene scene = nullptr;
        std::vector<ObjectId> objects;
    };

    std::vector<SceneHandle> scenes_;
    std::vector<Body> by_model_;
};

class EmbreeMovables {
  public:
    explicit EmbreeMovables(const SharedScene& scene);

    void move(ModelId model, const Pose& world_from_model);
    /// All that can move and has geometry.
    [[nodiscard]] std::span<const ModelId> all() const { return instances_; }

    /// trace() meets these from now on, where they are now.
    void show(std::span<const ModelId> models);
    /// The hits of the packet so far have shortened its rays: only what stands before is met.
    void trace(CoherentTracer& tracer, const int* valid, RTCRayHit16& packet) const;
    /// Traces one model, which need not be shown.
    void trace_alone(ModelId model, CoherentTracer& tracer, const int* valid,
                     RTCRayHit16& packet) const;

    /// That ray k has hit.
    [[nodiscard]] ObjectId object(const RTCHit16& hit, std::size_t k) const {
        return bodies_.object(hit.instID[0][k], hit.geomID[k]);
    }

  private:
    struct Movable {
        GeometryHandle instance;  ///< null: it stands still, or has no geometry
        glm::mat3 world_from_model{1.0F};
        glm::vec3 anchored_at_m{0.0F};
        bool moved = false;       ///< its instance is where it was before
        bool shown = false;       ///< its instance is in the scene
        std::uint64_t asked = 0;  ///< the latest show() that named it
    };

    void place(Movable& movable);
    void turn_normals(const int* valid, RTCRayHit16& packet) const;
    /// Turns the normal of ray k from the model's frame to W.
    void set_normal(RTCHit16& hit, std::size_t k, ModelId model, const RTCHit16& in_model) const;

    SharedScene scene_;
    DeviceHandle device_;  ///< null: nothing can move
    EmbreeBodies bodies_;
    SceneHandle moving_;             ///< instances, under their models' ids
    std::vector<Movable> movables_;  ///< by ModelId; empty where nothing can move
    std::vector<ModelId> instances_;
    std::vector<ModelId> shown_;
    std::uint64_t shows_ = 0;
};

}  // namespace scipd::sim
