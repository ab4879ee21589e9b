// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the beams of a drive met and passed, in the cells of a grid: the counting model, whose cell
// holds a face where beams ended that often. Values; one thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/export/floor_map.h"
#include "tools/scipfit/drive.h"

namespace scipd::tools {

class DriveGrid {
  public:
    /// Around all of the drive. Throws WrongInput where that has too many cells.
    DriveGrid(const std::vector<DriveScan>& drive, double cell_m);

    void add(const DriveScan& scan, const LaserPose& pose);

    /// How far a point is from the nearest face that was met, where one is in its cell or a
    /// neighbour.
    [[nodiscard]] std::optional<double> distance_m(const Point& point) const;

    [[nodiscard]] double cell_m() const { return cell_m_; }
    [[nodiscard]] sim::FloorMap floor_map() const;

  private:
    struct Cell {
        float x_m = 0.0F, y_m = 0.0F;  ///< sums over the ends within, from the middle of the cell
        std::uint32_t met = 0;
        std::uint32_t passed = 0;

        [[nodiscard]] bool holds_a_face() const;
    };
    struct Index {
        std::ptrdiff_t column = 0;
        std::ptrdiff_t row = 0;
        bool operator==(const Index&) const = default;
    };

    [[nodiscard]] Index index_of(const Point& point) const;
    [[nodiscard]] Point middle_of(Index index) const;
    [[nodiscard]] bool has(Index index) const;
    [[nodiscard]] Cell& at(Index index);
    [[nodiscard]] const Cell& at(Index index) const;
    void pass(Index from, Index to);

    double cell_m_;
    Point origin_;
    std::ptrdiff_t columns_ = 0;
    std::ptrdiff_t rows_ = 0;
    std::vector<Cell> cells_;
};

}  // namespace scipd::tools
