// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns cells of a grid into a solid between two heights with few, large faces. A run of cells that
// is the same in several rows becomes one block, and blocks have no faces where they touch.
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
    /// A map that needs more is noise, and its scene would exceed the memory of most machines.
    std::size_t most_triangles = 20'000'000;
};

/// x and y are relative to the middle of the grid, since floats are finest near 0. Throws
/// std::invalid_argument if the mesh would have more than `most_triangles`.
Mesh wall_mesh(const CellGrid& grid, Cell which, const WallSize& size);

}  // namespace scipd::sim
