// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns walls of MVSim into boxes. Pure. Throws std::invalid_argument, saying what cannot be read.
#pragma once

#include <vector>

#include "sim/loaders/mvsim/mvsim_node.h"
#include "sim/world/shape.h"

namespace scipd::sim {

struct PlacedBox {
    Box box;
    Pose world_from_box;
};

/// `<element class="vertical_plane">`: the wall without its doors and windows.
std::vector<PlacedBox> plane_boxes(const MvsimNode& plane);

/// `<walls>`: one wall between each pair of points. If an earlier wall begins or ends near one of
/// its ends, the wall is longer there by half its thickness, so that corners are closed.
std::vector<PlacedBox> wall_boxes(const MvsimNode& walls);

}  // namespace scipd::sim
