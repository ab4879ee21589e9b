// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Cells of a grid as a solid between two heights, in few large faces: blocks of equal runs of
// cells, without the faces between them.
//
//      +--+--------+        A cap is cut along the rows into blocks; where a block ends, its
//      |  |   B    |        neighbours above and below have a corner as well, so that every edge
//      +--+--+-----+        belongs to exactly two faces and no ray slips through.
//      |  A  |
//      +-----+
//
// Pure.
#pragma once

#include <cstddef>

#include "sim/loaders/map/occupancy.h"
#include "sim/world/mesh.h"

namespace scipd::sim {

struct WallSize {
    double cell_m;
    double bottom_m;
    double top_m;
    /// Past this a map is noise, and a scene of it would not fit into most machines.
    std::size_t most_triangles = 20'000'000;
};

/// x and y from the middle of the grid, where floats are finest. Throws std::invalid_argument where
/// it would take more triangles.
Mesh wall_mesh(const CellGrid& grid, Cell which, const WallSize& size);

}  // namespace scipd::sim
