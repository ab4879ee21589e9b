// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Objects of a scene as Embree's geometries. Lives on the thread that builds the backend.
#pragma once

#include "sim/backends/embree_api.h"
#include "sim/world/pose.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// The triangles of one object, at this pose in the frame of `scene`, under the object's own id.
void attach(RTCDevice device, RTCScene scene, ObjectId id, const Object& object,
            const Pose& here_from_object, RTCFilterFunctionN filter = nullptr);

}  // namespace scipd::sim
