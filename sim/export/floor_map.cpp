// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/export/floor_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "sim/export/map_values.h"

namespace scipd::sim {
namespace {

using Polygon = std::vector<glm::dvec3>;

constexpr double most_cells = 1e8;

/// In metres.
std::string millimetres(double length_m) {
    return short_text(std::round(1000.0 * length_m) / 1000.0 + 0.0);
}

/// The part of a convex polygon whose coordinate `axis` is at least `from`; at most, if `sign` is
/// -1. (Sutherland and Hodgman, Reentrant polygon clipping, 1974.)
Polygon cut(const Polygon& polygon, int axis, double from, double sign) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double a_in = sign * (a[axis] - from);
        const double b_in = sign * (b[axis] - from);
        if (a_in >= 0.0) kept.push_back(a);
        if ((a_in >= 0.0) == (b_in >= 0.0)) continue;
        glm::dvec3 between = glm::mix(a, b, a_in / (a_in - b_in));
        between[axis] = from;
        kept.push_back(between);
    }
    return kept;
}

/// The smallest box around points.
struct Span {
    glm::dvec3 low_m{std::numeric_limits<double>::infinity()};
    glm::dvec3 high_m{-std::numeric_limits<double>::infinity()};

    void include(const Polygon& polygon) {
        for (const glm::dvec3& point : polygon)
            include(point);
    }
    void include(const glm::dvec3& point) {
        low_m = glm::min(low_m, point);
        high_m = glm::max(high_m, point);
    }
    [[nodiscard]] bool is_empty() const { return low_m.x > high_m.x; }
};

/// What lies in the band of heights: faces cut to it, seen from above.
struct Slice {
    std::vector<Polygon> faces;
    Span span;
    Span whole;  ///< of the world
};

Slice slice_of(const std::vector<PlacedMesh>& meshes, const FloorMapOptions& options) {
    Slice slice;
    for (const PlacedMesh& placed : meshes) {
        for (const glm::uvec3& corners : placed.mesh->triangles) {
            const Polygon triangle{placed.vertex_m(corners.x), placed.vertex_m(corners.y),
                                   placed.vertex_m(corners.z)};
            Span span;
            span.include(triangle);
            slice.whole.include(triangle);
            // A beam in this plane runs along such a face and does not meet it.
            const bool is_along = options.low_m == options.high_m && span.low_m.z == span.high_m.z;
            if (is_along || span.high_m.z < options.low_m || span.low_m.z > options.high_m)
                continue;
            Polygon face = cut(cut(triangle, 2, options.low_m, 1.0), 2, options.high_m, -1.0);
            if (face.empty()) continue;
            slice.span.include(face);
            slice.faces.push_back(std::move(face));
        }
    }
    return slice;
}

class Grid {
  public:
    Grid(const Span& span, double resolution_m) : resolution_m_(resolution_m) {
        first_ = cell_of({span.low_m.x, span.low_m.y}) - glm::dvec2{1.0};
        size_ = cell_of({span.high_m.x, span.high_m.y}) - first_ + glm::dvec2{2.0};
    }

    [[nodiscard]] double cells() const { return size_.x * size_.y; }
    [[nodiscard]] FloorMap empty_map() const {
        FloorMap map{first_ * resolution_m_, resolution_m_, static_cast<std::size_t>(size_.x),
                     static_cast<std::size_t>(size_.y)};
        map.cells.resize(map.columns * map.rows, MapCell::unknown);
        return map;
    }
    /// Where a place is in the cells of the map.
    [[nodiscard]] std::size_t index_of(const glm::dvec2& at_m) const {
        const glm::dvec2 cell = cell_of(at_m) - first_;
        return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(cell.x);
    }

    /// All cells that it passes through: row by row, since what is convex is one piece in each.
    void fill(const Polygon& face, FloorMap& map) const {
        Span span;
        span.include(face);
        const double last = cell_of({0.0, span.high_m.y}).y;
        for (double row = cell_of({0.0, span.low_m.y}).y; row <= last; ++row) {
            Span in_row;
            in_row.include(
                cut(cut(face, 1, row * resolution_m_, 1.0), 1, (row + 1.0) * resolution_m_, -1.0));
            if (in_row.is_empty()) continue;
            const double y_m = (row + 0.5) * resolution_m_;
            const auto begin = index_of({in_row.low_m.x, y_m});
            const auto end = index_of({in_row.high_m.x, y_m}) + 1;
            std::fill(map.cells.begin() + static_cast<std::ptrdiff_t>(begin),
                      map.cells.begin() + static_cast<std::ptrdiff_t>(end), MapCell::occupied);
        }
    }

  private:
    [[nodiscard]] glm::dvec2 cell_of(const glm::dvec2& at_m) const {
        return glm::floor(at_m / resolution_m_);
    }

    double resolution_m_;
    glm::dvec2 first_{0.0};
    glm::dvec2 size_{0.0};
};

/// Makes free what can be reached from here.
void free_from(std::size_t start, FloorMap& map) {
    std::vector<std::size_t> open{start};
    while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        if (map.cells[at] != MapCell::unknown) continue;
        map.cells[at] = MapCell::free;
        const std::size_t column = at % map.columns;
        if (column > 0) open.push_back(at - 1);
        if (column + 1 < map.columns) open.push_back(at + 1);
        if (at >= map.columns) open.push_back(at - map.columns);
        if (at + map.columns < map.cells.size()) open.push_back(at + map.columns);
    }
}

}  // namespace

Expected<FloorMap> floor_map(const std::vector<PlacedMesh>& meshes,
                             const FloorMapOptions& options) {
    Slice slice = slice_of(meshes, options);
    if (slice.faces.empty()) {
        const std::string world = slice.whole.is_empty()
                                      ? "is empty"
                                      : "reaches from z = " + millimetres(slice.whole.low_m.z) +
                                            " to " + millimetres(slice.whole.high_m.z) + " m";
        return refuse("nothing is at z = " + short_text(options.low_m) +
                      (options.low_m == options.high_m ? "" : " to " + short_text(options.high_m)) +
                      " m: the world " + world);
    }
    for (const glm::dvec2& robot_m : options.robots_m)
        slice.span.include(glm::dvec3{robot_m, options.low_m});
    const Grid grid(slice.span, options.resolution_m);
    if (!(grid.cells() <= most_cells)) {
        return refuse("a map of " + short_text(slice.span.high_m.x - slice.span.low_m.x) + " x " +
                      short_text(slice.span.high_m.y - slice.span.low_m.y) + " m has " +
                      short_text(grid.cells()) + " cells, and 1e8 are allowed: take larger ones");
    }
    FloorMap map = grid.empty_map();
    for (const Polygon& face : slice.faces)
        grid.fill(face, map);
    for (const glm::dvec2& robot_m : options.robots_m)
        free_from(grid.index_of(robot_m), map);
    map.is_closed = std::ranges::find(map.cells, MapCell::free) != map.cells.end();
    if (!map.is_closed) std::ranges::replace(map.cells, MapCell::unknown, MapCell::free);
    return map;
}

}  // namespace scipd::sim
