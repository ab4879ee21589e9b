// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <glm/geometric.hpp>

#include "sim/world/pose_track.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// A movable model and where it is when. A view: whoever owns the track outlives it.
struct Mover {
    ModelId id = no_model;
    double radius_m = 0.0;  ///< of all its points around its origin
    const PoseTrack* path = nullptr;
};

/// The longest path that any point of the model takes on this leg.
[[nodiscard]] inline double path_length_m(const PoseTrack::Leg& leg, double radius_m) {
    return glm::distance(leg.from_m, leg.to_m) + leg.turned_rad * radius_m;
}

}  // namespace scipd::sim
