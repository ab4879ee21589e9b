// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/wall_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scipd::tools {
namespace {

double angle_between(double a, double b) {
    return std::remainder(a - b, 2.0 * std::acos(-1.0));
}

Point at(const Wall& wall, double angle_rad) {
    const double range_m = wall.range_m(angle_rad);
    return {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
}

std::optional<Point> meeting_of(const Wall& a, const Wall& b) {
    const double cross = std::sin(angle_between(b.normal_rad, a.normal_rad));
    if (std::abs(cross) < 0.2) return std::nullopt;
    return Point{
        (a.distance_m * std::sin(b.normal_rad) - b.distance_m * std::sin(a.normal_rad)) / cross,
        (b.distance_m * std::cos(a.normal_rad) - a.distance_m * std::cos(b.normal_rad)) / cross};
}

/// So far off a corner the middles of beams may lie that look into it.
double room_of_corner_m(const Point& corner, double beam_rad) {
    return 0.03 + 4.0 * beam_rad * std::hypot(corner.x_m, corner.y_m);
}

/// Whether the two meet where their beams do; then they end there.
bool join_corner(Wall& a, Wall& b, double beam_rad) {
    const auto corner = meeting_of(a, b);
    if (!corner) return false;
    const double room_m = room_of_corner_m(*corner, beam_rad);
    const auto near = [&](const Point& end) {
        return std::hypot(end.x_m - corner->x_m, end.y_m - corner->y_m) < 3.0 * room_m;
    };
    if (!near(a.end) || !near(b.begin)) return false;
    a.end = b.begin = *corner;
    return true;
}

/// How much of the beams between two walls falls on the first one, in beams: those that an edge
/// mixes lie between both.
double beams_on_first(const Wall& a, const Wall& b, const ScanTable& readings,
                      const std::vector<Beam>& beams) {
    double sum = 0.0;
    for (std::size_t step = a.last + 1; step < b.first; ++step) {
        const double angle_rad = readings.angle_rad(step);
        const double apart_m = b.range_m(angle_rad) - a.range_m(angle_rad);
        const double seen_m = beams[step].mean_mm / 1000.0;
        const double share = (b.range_m(angle_rad) - seen_m) / apart_m;
        sum += beams[step].count > 0 ? std::clamp(share, 0.0, 1.0) : 0.5;
    }
    return sum;
}

/// The nearer one ends within the beams between them, and the farther one goes on behind it.
void end_at_edge(Wall& a, Wall& b, const ScanTable& readings, const std::vector<Beam>& beams) {
    constexpr double hidden_beams = 3.0;
    const double last = static_cast<double>(a.last) + 0.5 + beams_on_first(a, b, readings, beams);
    const double edge_rad = readings.angle_rad(0) + readings.beam_rad() * last;
    const double hidden_rad = hidden_beams * readings.beam_rad();
    const bool a_is_nearer = a.range_m(edge_rad) < b.range_m(edge_rad);
    a.end = at(a, a_is_nearer ? edge_rad : edge_rad + hidden_rad);
    b.begin = at(b, a_is_nearer ? edge_rad - hidden_rad : edge_rad);
}

/// Half a beam beyond the last one. Where the scanner looks no farther, walls go on.
void end_by_themselves(std::vector<Wall>& walls, const ScanTable& readings) {
    const auto beyond = [&](bool at_rim) { return (at_rim ? 3.0 : 0.5) * readings.beam_rad(); };
    for (Wall& wall : walls) {
        const bool is_last = wall.last + 1 == readings.beams;
        wall.begin = at(wall, readings.angle_rad(wall.first) - beyond(wall.first == 0));
        wall.end = at(wall, readings.angle_rad(wall.last) + beyond(is_last));
    }
}

/// Whether a few beams look into the corner of the walls on either side: each sees some of both, so
/// they lie on a line of their own, which is no wall.
bool is_corner(const Wall& a, const Wall& between, const Wall& b, const ScanTable& readings) {
    constexpr std::size_t most_beams = 8;
    if (between.last - between.first >= most_beams) return false;
    if (between.first > a.last + 1 || b.first > between.last + 1) return false;
    const auto corner = meeting_of(a, b);
    if (!corner) return false;
    const double angle_rad = std::atan2(corner->y_m, corner->x_m);
    const double middle_rad =
        0.5 * (readings.angle_rad(between.first) + readings.angle_rad(between.last));
    const double beams = static_cast<double>(between.last - between.first) + 2.0;
    return std::abs(angle_between(angle_rad, middle_rad)) < 0.5 * beams * readings.beam_rad() &&
           std::abs(between.range_m(middle_rad) - std::hypot(corner->x_m, corner->y_m)) <
               room_of_corner_m(*corner, readings.beam_rad());
}

void leave_out_corners(const ScanTable& readings, std::vector<Wall>& walls) {
    for (std::size_t i = 1; i + 1 < walls.size(); ++i) {
        if (is_corner(walls[i - 1], walls[i], walls[i + 1], readings))
            walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

}  // namespace

void find_ends(std::vector<Wall>& walls, const ScanTable& readings,
               const std::vector<Beam>& beams) {
    constexpr std::size_t most_between = 4;
    constexpr std::size_t most_in_corner = 10;
    leave_out_corners(readings, walls);
    end_by_themselves(walls, readings);
    for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
        Wall& a = walls[i];
        Wall& b = walls[i + 1];
        const std::size_t apart = b.first - a.last;
        if (apart <= most_in_corner && join_corner(a, b, readings.beam_rad())) continue;
        if (apart <= most_between) end_at_edge(a, b, readings, beams);
    }
}

}  // namespace scipd::tools
