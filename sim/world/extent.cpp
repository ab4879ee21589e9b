// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/extent.h"

namespace scipd::sim {

Bounds bounds_in_world(const Scene& scene, const Object& object) {
    Bounds bounds;
    bounds.include(bounds_of(object.shape),
                   scene.models[object.model].world_from_model * object.model_from_object);
    return bounds;
}

Bounds extent_of(const Scene& scene) {
    Bounds extent;
    for (const Object& object : scene.objects)
        extent.include(bounds_in_world(scene, object), Pose{});
    return extent;
}

}  // namespace scipd::sim
