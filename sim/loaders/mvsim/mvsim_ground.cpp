// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

double resolution_m(const MvsimNode& node, double otherwise_m) {
    const double said_m = node.number("resolution", otherwise_m);
    if (said_m >= 1e-4 && said_m <= 1e3) return said_m;
    throw std::invalid_argument("<resolution> must be within 0.0001 and 1000 m a pixel");
}

glm::dvec3 checked(const glm::dvec3& xyz_m) {
    if (plausible_position(xyz_m)) return xyz_m;
    throw std::invalid_argument("must lie within 1e7 m of the origin");
}

/// The mean of the colours, from 0 to 1.
std::vector<float> greys_of(const MapImage& image) {
    std::vector<float> greys;
    greys.reserve(image.width * image.height);
    const unsigned colours = image.channels < 3 ? 1 : 3;
    std::visit(
        [&](const auto& samples) {
            for (std::size_t first = 0; first < samples.size(); first += image.channels) {
                float sum = 0.0F;
                for (unsigned i = 0; i < colours; ++i)
                    sum += static_cast<float>(samples[first + i]);
                greys.push_back(sum / static_cast<float>(colours * image.white));
            }
        },
        image.samples);
    return greys;
}

/// Cells are cut along the diagonal from their corner of the least x and y.
void add_cells(std::size_t rows, std::size_t columns, Mesh& mesh) {
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto here = static_cast<glm::uint>(row * columns + column);
            const auto next = static_cast<glm::uint>(here + columns);
            mesh.triangles.emplace_back(here, here + 1, next + 1);
            mesh.triangles.emplace_back(here, next, next + 1);
        }
    }
}

/// Row after row.
struct Heights {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> all_m;
};

void append_row(std::string_view row, Heights& heights) {
    constexpr auto blanks = " \t\r\n,";
    const std::size_t before = heights.all_m.size();
    for (auto begin = row.find_first_not_of(blanks); begin != row.npos;
         begin = row.find_first_not_of(blanks)) {
        row.remove_prefix(begin);
        const std::string_view word = row.substr(0, row.find_first_of(blanks));
        row.remove_prefix(word.size());
        const auto number = parse_number(word.starts_with('+') ? word.substr(1) : word);
        if (!number) {
            throw std::invalid_argument("<elevation_data_matrix> wants numbers, not " +
                                        quote(word));
        }
        heights.all_m.push_back(static_cast<float>(*number));
    }
    const std::size_t columns = heights.all_m.size() - before;
    if (columns == 0) return;
    if (heights.rows++ == 0) heights.columns = columns;
    if (columns != heights.columns) {
        throw std::invalid_argument("<elevation_data_matrix> has rows of " +
                                    std::to_string(heights.columns) + " and of " +
                                    std::to_string(columns) + " numbers");
    }
}

/// Reads a matrix as Matlab writes it: [1 0 2; 0 4 -1].
Heights heights_in(std::string_view text) {
    text = trimmed(text);
    if (!text.starts_with('[') || !text.ends_with(']')) {
        throw std::invalid_argument(
            "<elevation_data_matrix> must be in brackets, its rows divided by semicolons: "
            "[0 0; 1 1]");
    }
    text.remove_prefix(1);
    text.remove_suffix(1);
    Heights heights;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        append_row(text.substr(0, end), heights);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return heights;
}

PlacedMesh terrain(const MvsimNode& map, const Heights& heights) {
    constexpr std::size_t most_cells = 10'000'000;
    const auto& [rows, columns, all_m] = heights;
    if (rows < 2 || columns < 2 || all_m.size() > most_cells) {
        throw std::invalid_argument("wants heights of 2 x 2 to 10 million places");
    }
    const double cell_m = resolution_m(map, 1.0);
    Mesh mesh;
    for (std::size_t i = 0; i < all_m.size(); ++i) {
        mesh.vertices_m.emplace_back(cell_m * double(i / columns), cell_m * double(i % columns),
                                     all_m[i]);
    }
    add_cells(rows, columns, mesh);
    const glm::dvec2 span_m = cell_m * glm::dvec2{rows - 1, columns - 1};
    const auto [lowest_m, highest_m] = std::ranges::minmax(all_m);
    checked({span_m, highest_m});
    checked({span_m, lowest_m});
    return {std::move(mesh), checked({map.number("corner_min_x", -0.5 * span_m.x),
                                      map.number("corner_min_y", -0.5 * span_m.y), 0.0})};
}

constexpr std::size_t most_pieces = 10'000;

/// x runs along a wall, y up, in metres.
struct Rectangle {
    glm::dvec2 low;
    glm::dvec2 high;

    [[nodiscard]] bool empty() const { return !(low.x < high.x && low.y < high.y); }
};

/// The rest around a hole: left, right, below, above.
std::array<Rectangle, 4> cut(const Rectangle& piece, const Rectangle& hole) {
    const double from = std::clamp(hole.low.x, piece.low.x, piece.high.x);
    const double to = std::clamp(hole.high.x, piece.low.x, piece.high.x);
    const double bottom = std::clamp(hole.low.y, piece.low.y, piece.high.y);
    const double top = std::clamp(hole.high.y, piece.low.y, piece.high.y);
    return {{{piece.low, {from, piece.high.y}},
             {{to, piece.low.y}, piece.high},
             {{from, piece.low.y}, {to, bottom}},
             {{from, top}, {to, piece.high.y}}}};
}

void cut_all(std::vector<Rectangle>& pieces, const Rectangle& hole) {
    std::vector<Rectangle> rest;
    for (const Rectangle& piece : pieces) {
        for (const Rectangle& left : cut(piece, hole)) {
            if (!left.empty()) rest.push_back(left);
        }
    }
    if (rest.size() > most_pieces) throw std::invalid_argument("has too many doors and windows");
    pieces = std::move(rest);
}

Rectangle opening(const MvsimNode& node, double length_m) {
    const double middle_m = node.attribute_or_child("position", 0.5) * length_m;
    const double half_m = 0.5 * node.attribute_or_child("width", 1.0);
    return {{middle_m - half_m, node.attribute_or_child("z_min", 0.0)},
            {middle_m + half_m, node.attribute_or_child("z_max", 2.1)}};
}

PlacedBox box_between(const glm::dvec2& from_m, const glm::dvec2& to_m, double thickness_m,
                      double bottom_m, double top_m) {
    const glm::dvec2 along = to_m - from_m;
    const Box box{{glm::length(along), thickness_m, top_m - bottom_m}};
    const bool is_solid = std::min({box.size_m.x, box.size_m.y, box.size_m.z}) > 0.0;
    const glm::dvec3 middle_m{0.5 * (from_m + to_m), 0.5 * (bottom_m + top_m)};
    if (!is_solid || !plausible_position(box.size_m) || !plausible_position(middle_m)) {
        throw std::invalid_argument("must be longer, thicker and higher than 0 and within 1e7 m");
    }
    return {box, pose_from_rpy(middle_m, {0.0, 0.0, std::atan2(along.y, along.x)})};
}

/// Four rows of four numbers, with Matlab's brackets and semicolons, as MVSim reads them.
std::vector<double> transformation(const MvsimNode& walls) {
    auto text = walls.text("transformation");
    if (!text) return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::ranges::replace_if(
        *text, [](char c) { return c == '[' || c == ']' || c == ';' || c == ','; }, ' ');
    return numbers_in(*text, 16, "transformation");
}

/// Returns true if one of the first `count` points is so near.
bool any_near(const std::vector<glm::dvec2>& points, std::size_t count, const glm::dvec2& here,
              double distance_m) {
    return std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const glm::dvec2& p) { return glm::distance(p, here) < distance_m; });
}

}  // namespace

PlacedMesh grid_mesh(const MvsimNode& grid, std::string_view picture, double bottom_m,
                     double top_m) {
    MapFile map;
    map.mode = MapMode::scale;
    map.resolution_m = resolution_m(grid, 0.1);
    map.occupied_above = 0.5;
    map.free_below = 0.5;
    const CellGrid cells = cells_of(read_map_image(picture), map);
    const double columns = static_cast<double>(cells.columns);
    const double rows = static_cast<double>(cells.rows);
    const glm::dvec2 origin{grid.number("centerpixel_x", 0.5 * columns),
                            grid.number("centerpixel_y", 0.5 * rows)};
    const glm::dvec2 middle_m = map.resolution_m * (0.5 * glm::dvec2{columns, rows} - origin);
    Mesh mesh = wall_mesh(cells, Cell::occupied, {map.resolution_m, bottom_m, top_m});
    return {std::move(mesh), checked({middle_m, 0.0})};
}

PlacedMesh elevation_mesh(const MvsimNode& map, std::string_view picture) {
    const MapImage image = read_map_image(picture);
    const double low_m = map.number("elevation_image_min_z", 0.0);
    const double high_m = map.number("elevation_image_max_z", 5.0);
    std::vector<float> heights_m = greys_of(image);
    const auto [darkest, brightest] = std::ranges::minmax(heights_m);
    const double step_m = brightest > darkest ? (high_m - low_m) / (brightest - darkest) : 0.0;
    for (float& height_m : heights_m)
        height_m = static_cast<float>(low_m + step_m * (height_m - darkest));
    return terrain(map, {image.height, image.width, std::move(heights_m)});
}

PlacedMesh matrix_mesh(const MvsimNode& map, std::string_view matrix) {
    return terrain(map, heights_in(matrix));
}

std::vector<PlacedBox> plane_boxes(const MvsimNode& plane) {
    const glm::dvec2 from_m{plane.number("x0", -10.0), plane.number("y0", -10.0)};
    const glm::dvec2 to_m{plane.number("x1", -10.0), plane.number("y1", 10.0)};
    const double length_m = glm::distance(from_m, to_m);
    const double thickness_m = plane.number("thickness", 0.02);
    const double bottom_m = plane.number("z", 0.0);
    const double top_m = bottom_m + plane.number("height", 3.0);
    // Throws if this is no wall.
    (void)box_between(from_m, to_m, thickness_m, bottom_m, top_m);
    std::vector<Rectangle> pieces{{{0.0, bottom_m}, {length_m, top_m}}};
    for (const char* kind : {"door", "window"}) {
        for (const MvsimNode& hole : plane.children(kind))
            cut_all(pieces, opening(hole, length_m));
    }
    const glm::dvec2 along = (to_m - from_m) / length_m;
    std::vector<PlacedBox> boxes;
    for (const Rectangle& piece : pieces) {
        boxes.push_back(box_between(from_m + piece.low.x * along, from_m + piece.high.x * along,
                                    thickness_m, piece.low.y, piece.high.y));
    }
    return boxes;
}

std::vector<PlacedBox> wall_boxes(const MvsimNode& walls) {
    const double thickness_m = walls.number("wallThickness", 0.1);
    const double height_m = walls.number("wallHeight", 2.0);
    const auto matrix = transformation(walls);
    std::vector<glm::dvec2> points = walls.points();
    if (points.empty()) throw std::invalid_argument("has no <pt> in a <shape>, and so no wall");
    if (points.size() % 2 != 0) throw std::invalid_argument("wants pairs of <pt>");
    for (glm::dvec2& p : points) {
        p = {matrix[0] * p.x + matrix[1] * p.y + matrix[3],
             matrix[4] * p.x + matrix[5] * p.y + matrix[7]};
    }
    std::vector<PlacedBox> boxes;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        const glm::dvec2& from_m = points[i];
        const glm::dvec2& to_m = points[i + 1];
        if (from_m == to_m) throw std::invalid_argument("has a wall without length");
        const glm::dvec2 half_m = 0.5 * thickness_m * glm::normalize(to_m - from_m);
        const double near_m = 1.01 * thickness_m;
        boxes.push_back(box_between(any_near(points, i, from_m, near_m) ? from_m - half_m : from_m,
                                    any_near(points, i, to_m, near_m) ? to_m + half_m : to_m,
                                    thickness_m, 0.0, height_m));
    }
    return boxes;
}

}  // namespace scipd::sim
