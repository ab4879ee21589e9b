// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "sim/world/pose.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// A shape and its pose in the frame of the SDF geometry. The pose is needed because scipd's planes
/// are normal to z, while SDF's may have any normal.
struct PlacedShape {
    Shape shape;
    Pose geometry_from_shape;
};

}  // namespace scipd::sim
