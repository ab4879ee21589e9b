// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells from the pixels of a map which cells are occupied, free or unknown. The rules are those of
// map_server, computed in double with a single rounding, so that a grey of 102 lies exactly on a
// threshold of 0.6. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/loaders/map/map_file.h"
#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

enum class Cell : std::uint8_t { free, occupied, unknown };

/// Rows from the bottom: y grows with the row, x with the column.
struct CellGrid {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<Cell> cells;

    [[nodiscard]] Cell at(std::size_t column, std::size_t row) const {
        return cells[row * columns + column];
    }
};

CellGrid cells_of(const MapImage& image, const MapFile& map);

}  // namespace scipd::sim
