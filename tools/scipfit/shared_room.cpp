// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/shared_room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/scipfit/wall_fit.h"

namespace scipd::tools {
namespace {

constexpr double near_mm = 60.0;

double turned_into_pi(double rad) {
    return std::remainder(rad, 2.0 * std::numbers::pi);
}

/// The plane through both ends of what was taken for two walls, since the scanner sees them bent.
Wall joined(const Wall& a, const Wall& b) {
    Wall wall = a;
    wall.end = b.end;
    wall.last = b.last;
    const double dx = wall.end.x_m - wall.begin.x_m;
    const double dy = wall.end.y_m - wall.begin.y_m;
    wall.normal_rad = std::atan2(-dx, dy);
    wall.distance_m =
        wall.begin.x_m * std::cos(wall.normal_rad) + wall.begin.y_m * std::sin(wall.normal_rad);
    return wall;
}

std::vector<Wall> straight_walls(const ScanTable& readings, const Station& station) {
    constexpr double hardly_rad = 0.05;
    constexpr double beside_m = 0.15;
    std::vector<Wall> walls;
    for (const Wall& wall : walls_of(readings, station)) {
        if (!walls.empty()) {
            Wall& before = walls.back();
            const double gap_m =
                std::hypot(wall.begin.x_m - before.end.x_m, wall.begin.y_m - before.end.y_m);
            const double turn_rad = turned_into_pi(wall.normal_rad - before.normal_rad);
            if (gap_m < beside_m && std::abs(turn_rad) < hardly_rad) {
                before = joined(before, wall);
                continue;
            }
        }
        walls.push_back(wall);
    }
    return walls;
}

struct Met {
    std::size_t wall = 0;
    double range_mm = std::numeric_limits<double>::infinity();
};

/// The first wall in this direction, seen from its face.
Met met_from(const FlatPose& place, double direction_rad, const std::vector<Wall>& walls) {
    const double x = std::cos(direction_rad);
    const double y = std::sin(direction_rad);
    Met met;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const double bx = 1000.0 * walls[i].begin.x_m - place.x_mm;
        const double by = 1000.0 * walls[i].begin.y_m - place.y_mm;
        const double dx = 1000.0 * (walls[i].end.x_m - walls[i].begin.x_m);
        const double dy = 1000.0 * (walls[i].end.y_m - walls[i].begin.y_m);
        const double cross = x * dy - y * dx;
        if (cross <= 0.0) continue;
        const double range = (bx * dy - by * dx) / cross;
        const double share = (bx * y - by * x) / cross;
        if (range > 0.0 && share >= 0.0 && share <= 1.0 && range < met.range_mm) met = {i, range};
    }
    return met;
}

/// The share of the beams that read what they would read there.
double agreement(const std::vector<Sight>& sights, const FlatPose& place,
                 const std::vector<Wall>& walls, std::size_t every) {
    double agree = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < sights.size(); i += every) {
        const Met met = met_from(place, place.yaw_rad + sights[i].angle_rad, walls);
        all += 1.0;
        if (std::abs(met.range_mm - sights[i].range_mm) < near_mm) agree += 1.0;
    }
    return all > 0.0 ? agree / all : 0.0;
}

/// Where a scanner stands that sees a and b of the room as c and d; nothing where it cannot.
std::optional<FlatPose> place_by(const Wall& a, const Wall& b, const Wall& c, const Wall& d) {
    constexpr double alike_rad = 0.05;
    const double yaw = turned_into_pi(a.normal_rad - c.normal_rad);
    if (std::abs(turned_into_pi(b.normal_rad - d.normal_rad - yaw)) > alike_rad)
        return std::nullopt;
    // Both walls are so much nearer there than from the origin.
    const double nearer_a = 1000.0 * (a.distance_m - c.distance_m);
    const double nearer_b = 1000.0 * (b.distance_m - d.distance_m);
    const double sine = std::sin(b.normal_rad - a.normal_rad);
    return FlatPose{(nearer_a * std::sin(b.normal_rad) - nearer_b * std::sin(a.normal_rad)) / sine,
                    (nearer_b * std::cos(a.normal_rad) - nearer_a * std::cos(b.normal_rad)) / sine,
                    yaw};
}

bool are_parallel(const Wall& a, const Wall& b) {
    constexpr double least_sine = 0.35;
    return std::abs(std::sin(a.normal_rad - b.normal_rad)) < least_sine;
}

/// All pairs of walls that are not parallel, laid on each other.
std::optional<FlatPose> place_of(const Standing& standing, std::size_t station,
                                 const std::vector<Wall>& room) {
    constexpr double least_agreement = 0.6;
    constexpr std::size_t few = 12;
    const std::vector<Wall> seen = straight_walls(*standing.readings, standing.stations[station]);
    const std::vector<Sight> sights = sights_of(standing, station);
    std::optional<FlatPose> best;
    double most = 0.0;
    for (const Wall& a : room) {
        for (const Wall& b : room) {
            if (&a == &b || are_parallel(a, b)) continue;
            for (const Wall& c : seen) {
                for (const Wall& d : seen) {
                    if (&c == &d) continue;
                    const auto place = place_by(a, b, c, d);
                    if (!place) continue;
                    const double agree = agreement(sights, *place, room, few);
                    if (agree <= most) continue;
                    most = agree;
                    best = place;
                }
            }
        }
    }
    return most > least_agreement ? best : std::nullopt;
}

/// The longest: those of few beams tell no place.
std::vector<Wall> longest_of(std::vector<Wall> walls) {
    constexpr std::size_t least_beams = 12;
    constexpr std::size_t most_walls = 24;
    const auto beams = [](const Wall& wall) { return wall.last - wall.first + 1; };
    std::erase_if(walls, [&](const Wall& wall) { return beams(wall) < least_beams; });
    std::ranges::stable_sort(walls, std::greater{}, beams);
    if (walls.size() > most_walls) walls.resize(most_walls);
    return walls;
}

}  // namespace

std::vector<FaceLine> SharedRoom::faces() const {
    std::vector<FaceLine> lines;
    for (const Wall& wall : walls)
        lines.push_back({wall.normal_rad, 1000.0 * wall.distance_m});
    return lines;
}

std::optional<SharedRoom> shared_room(const Standing& standing) {
    if (standing.stations.size() < 2) return std::nullopt;
    SharedRoom room;
    room.walls = longest_of(straight_walls(*standing.readings, standing.stations[0]));
    for (std::size_t i = 0; i < standing.stations.size(); ++i) {
        const auto place = i == 0 ? FlatPose{} : place_of(standing, i, room.walls);
        room.placed.push_back(place.has_value());
        room.places.push_back(place.value_or(FlatPose{}));
    }
    if (std::ranges::count(room.placed, true) < 2) return std::nullopt;
    return room;
}

Sights look(const SharedRoom& room, const Standing& standing, const std::vector<FlatPose>& places) {
    Sights sights{.faces = room.faces(), .list = {}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!room.placed[i]) continue;
        for (Sight& sight : sights_of(standing, i)) {
            const Met met = met_from(places[i], places[i].yaw_rad + sight.angle_rad, room.walls);
            if (std::abs(met.range_mm - sight.range_mm) > near_mm) continue;
            sight.face = met.wall;
            sight.surface = met.wall;
            sights.list.push_back(sight);
        }
    }
    return sights;
}

}  // namespace scipd::tools
