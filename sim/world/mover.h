// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "sim/world/pose_track.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// A movable model and where it is when. A view: whoever owns the track outlives it.
struct Mover {
    ModelId id = no_model;
    double radius_m = 0.0;  ///< of all its points around its origin
    const PoseTrack* path = nullptr;
};

}  // namespace scipd::sim
