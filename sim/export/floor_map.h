// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner at some height can meet, as a grid seen from above. Not the files that hold it
// (ros_map_files.h). Values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/expected.h"
#include "sim/export/placed_mesh.h"

namespace scipd::sim {

struct FloorMapOptions {
    // The band of heights above z = 0 of the world that is looked at; both may be one height.
    double low_m = 0.17;
    double high_m = 0.17;
    double resolution_m = 0.05;  ///< the side of a cell
    /// Where robots are: what can be reached from there is free.
    std::vector<glm::dvec2> robots_m = {{0.0, 0.0}};
};

enum class MapCell : std::uint8_t { unknown, free, occupied };

/// A cell is free if a point that keeps off faces gets to its middle from a robot, through free
/// cells. It is occupied if a face passes through it or lies before it in a cell that is free: seen
/// from what is free, a wall begins at the border of cells that is next to its face. A face that is
/// free on both sides has one cell. All else is unknown, such as the inside of a wall. Where every
/// robot stands in a cell with a face, inside and outside are not known: then all cells without a
/// face are free.
struct FloorMap {
    glm::dvec2 origin_m{0.0};  ///< the lower left corner of the first cell, in the world
    double resolution_m = 0.0;
    std::size_t columns = 0;  ///< along x
    std::size_t rows = 0;     ///< along y
    std::vector<MapCell> cells = {};
    bool is_closed = true;  ///< some robot stands in what is free

    [[nodiscard]] MapCell at(std::size_t column, std::size_t row) const {
        return cells[row * columns + column];
    }
};

/// Refused with a sentence: nothing is at this height, or the grid would have more than 1e8 cells.
Expected<FloorMap> floor_map(const std::vector<PlacedMesh>& meshes, const FloorMapOptions& options);

}  // namespace scipd::sim
