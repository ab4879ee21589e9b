// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/drive_grid.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "tools/formatted.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

/// Refined places may lie beside those that were recorded.
constexpr double margin_m = 1.0;

struct Bounds {
    Point low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    Point high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};

    void take(const Point& point) {
        low = {std::min(low.x_m, point.x_m), std::min(low.y_m, point.y_m)};
        high = {std::max(high.x_m, point.x_m), std::max(high.y_m, point.y_m)};
    }
};

Bounds bounds_of(const std::vector<DriveScan>& drive) {
    Bounds bounds;
    for (const DriveScan& scan : drive) {
        bounds.take({scan.pose.x_m, scan.pose.y_m});
        for (const Point& seen : scan.seen)
            bounds.take(placed(scan.pose, seen));
    }
    return bounds;
}

}  // namespace

DriveGrid::DriveGrid(const std::vector<DriveScan>& drive, double cell_m) : cell_m_(cell_m) {
    constexpr double most_cells = 25e6;
    const Bounds bounds = bounds_of(drive);
    const double columns = std::ceil((bounds.high.x_m - bounds.low.x_m + 2 * margin_m) / cell_m);
    const double rows = std::ceil((bounds.high.y_m - bounds.low.y_m + 2 * margin_m) / cell_m);
    if (!(columns * rows <= most_cells))
        throw WrongInput(formatted(
            "the drive takes %.0f x %.0f m, which are more than 25 million cells of %g m; name a "
            "larger --resolution",
            columns * cell_m, rows * cell_m, cell_m));
    origin_ = {bounds.low.x_m - margin_m, bounds.low.y_m - margin_m};
    columns_ = static_cast<std::ptrdiff_t>(columns);
    rows_ = static_cast<std::ptrdiff_t>(rows);
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
}

// GMapping takes a cell for occupied by the same share (its occ_thresh): a wall that is seen at a
// slant is passed more often than met. One end alone may be anything.
bool DriveGrid::Cell::holds_a_face() const {
    constexpr std::uint32_t of = 4;
    return met >= 2 && met * of >= met + passed;
}

void DriveGrid::add(const DriveScan& scan, const LaserPose& pose) {
    const Index from = index_of({pose.x_m, pose.y_m});
    for (const Point& seen : scan.seen) {
        const Point end = placed(pose, seen);
        const Index to = index_of(end);
        if (!has(from) || !has(to)) continue;
        pass(from, to);
        Cell& cell = at(to);
        const Point middle = middle_of(to);
        cell.x_m += static_cast<float>(end.x_m - middle.x_m);
        cell.y_m += static_cast<float>(end.y_m - middle.y_m);
        ++cell.met;
    }
}

// Bresenham's line, without its end.
void DriveGrid::pass(Index from, Index to) {
    const std::ptrdiff_t across = std::abs(to.column - from.column);
    const std::ptrdiff_t up = std::abs(to.row - from.row);
    const std::ptrdiff_t right = from.column < to.column ? 1 : -1;
    const std::ptrdiff_t higher = from.row < to.row ? 1 : -1;
    std::ptrdiff_t error = across - up;
    while (from != to) {
        ++at(from).passed;
        const std::ptrdiff_t twice = 2 * error;
        if (twice > -up) {
            error -= up;
            from.column += right;
        }
        if (twice < across) {
            error += across;
            from.row += higher;
        }
    }
}

std::optional<double> DriveGrid::distance_m(const Point& point) const {
    const Index middle = index_of(point);
    std::optional<double> nearest_m;
    for (std::ptrdiff_t row = middle.row - 1; row <= middle.row + 1; ++row) {
        for (std::ptrdiff_t column = middle.column - 1; column <= middle.column + 1; ++column) {
            const Index index{column, row};
            if (!has(index) || !at(index).holds_a_face()) continue;
            const Cell& cell = at(index);
            const Point face = middle_of(index);
            const double count = cell.met;
            const double m = std::hypot(face.x_m + cell.x_m / count - point.x_m,
                                        face.y_m + cell.y_m / count - point.y_m);
            nearest_m = std::min(nearest_m.value_or(m), m);
        }
    }
    return nearest_m;
}

sim::FloorMap DriveGrid::floor_map() const {
    sim::FloorMap map{.origin_m = {origin_.x_m, origin_.y_m},
                      .resolution_m = cell_m_,
                      .columns = static_cast<std::size_t>(columns_),
                      .rows = static_cast<std::size_t>(rows_)};
    for (const Cell& cell : cells_) {
        const bool seen = cell.met + cell.passed > 0;
        map.cells.push_back(cell.holds_a_face() ? sim::MapCell::occupied
                            : seen              ? sim::MapCell::free
                                                : sim::MapCell::unknown);
    }
    return map;
}

DriveGrid::Index DriveGrid::index_of(const Point& point) const {
    return {static_cast<std::ptrdiff_t>(std::floor((point.x_m - origin_.x_m) / cell_m_)),
            static_cast<std::ptrdiff_t>(std::floor((point.y_m - origin_.y_m) / cell_m_))};
}

Point DriveGrid::middle_of(Index index) const {
    return {origin_.x_m + (static_cast<double>(index.column) + 0.5) * cell_m_,
            origin_.y_m + (static_cast<double>(index.row) + 0.5) * cell_m_};
}

bool DriveGrid::has(Index index) const {
    return index.column >= 0 && index.column < columns_ && index.row >= 0 && index.row < rows_;
}

DriveGrid::Cell& DriveGrid::at(Index index) {
    return cells_[static_cast<std::size_t>(index.row * columns_ + index.column)];
}

const DriveGrid::Cell& DriveGrid::at(Index index) const {
    return cells_[static_cast<std::size_t>(index.row * columns_ + index.column)];
}

}  // namespace scipd::tools
