// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The yardstick: the shortest loop around rtcIntersect16 that turns directions into ranges, and on
// request into materials. It uses robust scenes, one mesh for each object and coherent packets. It
// leaves out incidence, moving models, bodies to look through, and all checks. One thread.
#pragma once

#include <span>
#include <vector>

#if SCIPD_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include "sim/world/scene.h"

namespace scipd::sim {

class BareEmbree {
  public:
    /// How models that could move enter the scene.
    enum class Movables {
        still,      ///< everything is in one scene
        instances,  ///< as in the backend: a second scene of instances, traced after the first
    };

    /// From now on this thread treats denormal numbers as zero.
    explicit BareEmbree(const Scene& scene, Movables movables = Movables::still);
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;
    ~BareEmbree();

    /// Takes one pose, or one for each direction. `materials` is empty, or has room for all
    /// directions.
    void cast(std::span<const glm::vec3> directions, std::span<const Pose> poses, float max_range_m,
              std::span<float> range_m, std::span<MaterialId> materials = {}) const;

  private:
    [[nodiscard]] RTCScene new_scene() const;
    void add(RTCScene scene, ObjectId id, const Object& object, const Pose& here_from_object);
    void add_instance(ModelId id, const Pose& anchored_from_model);

    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = new_scene();
    RTCScene moving_ = nullptr;     ///< null without instances
    std::vector<RTCScene> bodies_;  ///< by ModelId; null for models that cannot move
    std::vector<MaterialId> material_of_;
    glm::dvec3 anchor_m_;
};

}  // namespace scipd::sim
