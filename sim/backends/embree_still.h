// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What never moves in a scene, as Embree searches it: by far most of the memory of a backend. All
// backends of the scene share it, on whichever threads they live, since nobody changes it.
#pragma once

#include <memory>

#include "sim/backends/embree_api.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

struct EmbreeStill {
    SharedScene of;
    DeviceHandle device;
    SceneHandle scene;  ///< in anchored W
};

/// Made once for each scene, for as long as somebody holds it. Any thread; one waits for another.
/// Throws std::runtime_error where Embree cannot.
[[nodiscard]] std::shared_ptr<const EmbreeStill> still_part(const SharedScene& scene);

/// In W relative to the scene's anchor.
[[nodiscard]] inline Pose anchored(const Scene& scene, const Pose& world_from_thing) {
    return {world_from_thing.translation_m - scene.anchor_m, world_from_thing.rotation};
}

/// Throws std::runtime_error where something has failed since the device was made.
void require_built(RTCDevice device, const Scene& scene);

/// The triangles of one object, at this pose in the frame of `scene`, under the object's own id.
void attach(RTCDevice device, RTCScene scene, ObjectId id, const Object& object,
            const Pose& here_from_object, RTCFilterFunctionN filter = nullptr);

}  // namespace scipd::sim
