// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Walls of MVSim as boxes. Pure; what cannot be read is thrown as std::invalid_argument.
#pragma once

#include <vector>

#include "sim/loaders/mvsim/mvsim_node.h"
#include "sim/world/shape.h"

namespace scipd::sim {

struct PlacedBox {
    Box box;
    Pose world_from_box;
};

/// `<element class="vertical_plane">`: what its doors and windows leave of it.
std::vector<PlacedBox> plane_boxes(const MvsimNode& plane);

/// `<walls>`: one between each pair of points, longer by half its thickness at either end where a
/// wall before it ends, so that corners are closed.
std::vector<PlacedBox> wall_boxes(const MvsimNode& walls);

}  // namespace scipd::sim
