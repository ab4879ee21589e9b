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

/// Marks of a cell: a face passes between its middle and that of the next cell along x, or along y;
/// it is occupied for a face of the cell before it.
enum Mark : std::uint8_t { cut_off_in_x = 1, cut_off_in_y = 2, pinned = 4 };
using Marks = std::vector<std::uint8_t>;

class Grid {
  public:
    Grid(const Span& span, double resolution_m) : resolution_m_(resolution_m) {
        first_ = glm::floor(in_cells(span.low_m)) - 1.0;
        size_ = glm::floor(in_cells(span.high_m)) + 2.0;
    }

    [[nodiscard]] double cells() const { return size_.x * size_.y; }
    [[nodiscard]] FloorMap empty_map() const {
        FloorMap map{first_ * resolution_m_, resolution_m_, static_cast<std::size_t>(size_.x),
                     static_cast<std::size_t>(size_.y)};
        map.cells.resize(map.columns * map.rows, MapCell::unknown);
        return map;
    }
    /// Index of the cell that holds a place.
    [[nodiscard]] std::size_t index_of(const glm::dvec2& at_m) const {
        return index(in_cells(at_m));
    }

    /// Occupies all cells that the face passes through, row by row, since a convex face is one
    /// piece in each; and marks the cells whose middles it separates.
    void fill(Polygon face, FloorMap& map, Marks& marks) const {
        Span span;
        for (glm::dvec3& point : face)
            span.include(point = {in_cells(point), point.z});
        for (double row = std::floor(span.low_m.y); row <= span.high_m.y; ++row) {
            Span in_row;
            in_row.include(cut(cut(face, 1, row, 1.0), 1, row + 1.0, -1.0));
            if (in_row.is_empty()) continue;
            const auto begin = static_cast<std::ptrdiff_t>(index({in_row.low_m.x, row}));
            const auto end = static_cast<std::ptrdiff_t>(index({in_row.high_m.x, row})) + 1;
            std::fill(map.cells.begin() + begin, map.cells.begin() + end, MapCell::occupied);
        }
        separate(face, span, 0, cut_off_in_x, marks);
        separate(face, span, 1, cut_off_in_y, marks);
    }

  private:
    /// From the lower left corner of the map. Vertices of meshes are in single precision: what lies
    /// just before the border of a cell is meant to be on it.
    [[nodiscard]] glm::dvec2 in_cells(const glm::dvec2& at_m) const {
        constexpr double nearly = 1e-3;
        return at_m / resolution_m_ + nearly - first_;
    }
    [[nodiscard]] std::size_t index(const glm::dvec2& cell) const {
        return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(cell.x);
    }
    /// Follows the lines through the middles of cells along one axis.
    void separate(const Polygon& face, const Span& span, int along, Mark mark, Marks& marks) const {
        const int across = 1 - along;
        for (double line = std::ceil(span.low_m[across] - 0.5) + 0.5; line <= span.high_m[across];
             ++line) {
            Span met;
            met.include(cut(cut(face, across, line, 1.0), across, line, -1.0));
            glm::dvec2 middle{line};
            middle[along] = std::floor(met.low_m[along] - 0.5) + 0.5;
            for (; middle[along] <= met.high_m[along]; ++middle[along])
                marks[index(middle)] |= mark;
        }
    }

    double resolution_m_;
    glm::dvec2 first_{0.0};  ///< cell of the map, counted from the origin of the world
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

/// Frees cells whose middle lies before the faces in them, as seen from what is free, and occupies
/// the cells behind. A wall then begins half a cell before its face to half a cell behind it, and
/// on the average at its face.
class Rounding {
  public:
    Rounding(FloorMap& map, Marks& marks) : map_(map), marks_(marks) {}

    void round_all() {
        std::vector<std::size_t> open;
        for (std::size_t first = 0; first < map_.cells.size(); ++first) {
            for (open.assign(1, first); !open.empty();) {
                const std::size_t at = open.back();
                open.pop_back();
                if (map_.cells[at] != MapCell::occupied || !make_free(at)) continue;
                open.insert(open.end(), {at - 1, at + 1, at - map_.columns, at + map_.columns});
            }
        }
    }

  private:
    /// The cell stays occupied where no free middle is seen from its own, where another cell would
    /// have to be free with it, and where no cell behind can take its faces.
    bool make_free(std::size_t at) {
        if ((marks_[at] & pinned) != 0) return false;
        const std::size_t columns = map_.columns;
        bool seen = false;
        std::vector<std::size_t> behind;
        const auto look = [&](std::size_t next, bool cut_off) {
            if (cut_off) behind.push_back(next);
            seen = seen || (!cut_off && map_.cells[next] == MapCell::free);
            return map_.cells[next] != (cut_off ? MapCell::free : MapCell::unknown);
        };
        const bool fits = look(at - 1, (marks_[at - 1] & cut_off_in_x) != 0) &&
                          look(at + 1, (marks_[at] & cut_off_in_x) != 0) &&
                          look(at - columns, (marks_[at - columns] & cut_off_in_y) != 0) &&
                          look(at + columns, (marks_[at] & cut_off_in_y) != 0);
        if (!fits || !seen) return false;
        const bool is_corner = behind.empty();  // or a thing that is smaller than a cell
        for (const std::size_t next :
             {at - columns - 1, at - columns + 1, at + columns - 1, at + columns + 1}) {
            // No ray slips through between cells that touch at a corner.
            const bool closes = !is_corner && map_.cells[next] == MapCell::unknown;
            const bool stands_for_it = is_corner && map_.cells[next] != MapCell::free;
            if (closes || stands_for_it) behind.push_back(next);
        }
        for (const std::size_t next : behind) {
            map_.cells[next] = MapCell::occupied;
            marks_[next] |= pinned;
        }
        if (!behind.empty()) map_.cells[at] = MapCell::free;
        return !behind.empty();
    }

    FloorMap& map_;
    Marks& marks_;
};

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
    Marks marks(map.cells.size());
    for (const Polygon& face : slice.faces)
        grid.fill(face, map, marks);
    for (const glm::dvec2& robot_m : options.robots_m)
        free_from(grid.index_of(robot_m), map);
    Rounding(map, marks).round_all();
    map.is_closed = std::ranges::find(map.cells, MapCell::free) != map.cells.end();
    if (!map.is_closed) std::ranges::replace(map.cells, MapCell::unknown, MapCell::free);
    return map;
}

}  // namespace scipd::sim
