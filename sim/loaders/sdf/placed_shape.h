// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "sim/world/pose.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// A shape, and how it lies in the frame that SDF gives to the geometry: our planes are normal to
/// z, theirs to anything.
struct PlacedShape {
    Shape shape;
    Pose geometry_from_shape;
};

}  // namespace scipd::sim
