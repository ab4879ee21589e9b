// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The geometry of movable models, as Embree searches it. Models of equal geometry share one body,
// as robots of one kind do: it takes memory once, and stays in the caches. Lives with its device.
#pragma once

#include <vector>

#include "sim/backends/embree_api.h"
#include "sim/world/scene.h"

namespace scipd::sim {

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

}  // namespace scipd::sim
