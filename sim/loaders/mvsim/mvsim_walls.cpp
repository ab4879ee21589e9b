// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_pieces = 10'000;

/// x runs along a wall, y up, in metres.
struct Rectangle {
    glm::dvec2 low;
    glm::dvec2 high;

    [[nodiscard]] bool empty() const { return !(low.x < high.x && low.y < high.y); }
};

/// What a hole leaves: left, right, below, above.
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

/// Whether one of the first `count` points is so near.
bool any_near(const std::vector<glm::dvec2>& points, std::size_t count, const glm::dvec2& here,
              double distance_m) {
    return std::any_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const glm::dvec2& p) { return glm::distance(p, here) < distance_m; });
}

}  // namespace

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
