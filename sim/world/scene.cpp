// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/scene.h"

#include "sim/world/bounds.h"

namespace scipd::sim {

glm::dvec3 Scene::middle_of(const Scene& scene) {
    Bounds bounds;
    for (const Object& object : scene.objects) {
        const Pose& world_from_model = scene.models[object.model].world_from_model;
        bounds.include(bounds_of(object.shape), world_from_model * object.model_from_object);
    }
    return bounds.empty() ? glm::dvec3{0.0} : bounds.middle_m();
}

}  // namespace scipd::sim
