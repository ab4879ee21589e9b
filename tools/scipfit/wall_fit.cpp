// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/wall_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <ceres/ceres.h>

namespace scipd::tools {
namespace {

constexpr std::size_t least_beams = 4;
constexpr double m_per_mm = 1e-3;

/// A beam's middle, seen from above.
struct Seen {
    std::size_t beam;
    double angle_rad;
    double range_m;
    double deviation_m;  ///< of the middle

    [[nodiscard]] Point point() const {
        return {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
    }
};

using Run = std::vector<Seen>;

/// So far off a line its points may lie.
double tolerance_m(const Seen& seen) {
    return 0.002 + 4.0 * seen.deviation_m;
}

/// Beams in a row that see something, without a jump.
std::vector<Run> runs_of(const Readings& readings, const Station& station) {
    constexpr double steepest = 10.0;
    std::vector<Run> runs;
    for (std::size_t beam = 0; beam < station.beams.size(); ++beam) {
        if (!station.beams[beam].still) continue;
        const Beam& of = station.beams[beam];
        const double deviation_mm = std::sqrt(of.variance_mm2 / static_cast<double>(of.count));
        const Seen seen{beam, readings.angle_rad(beam), of.mean_mm * m_per_mm,
                        deviation_mm * m_per_mm};
        const Seen* const before = runs.empty() ? nullptr : &runs.back().back();
        const bool goes_on = before != nullptr && beam - before->beam <= 2 &&
                             std::abs(seen.range_m - before->range_m) <
                                 steepest * readings.beam_rad * before->range_m + tolerance_m(seen);
        if (!goes_on) runs.emplace_back();
        runs.back().push_back(seen);
    }
    return runs;
}

/// How far off the line through two points another one lies.
double off_line_m(const Point& a, const Point& b, const Point& p) {
    const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (length == 0.0) return std::hypot(p.x_m - a.x_m, p.y_m - a.y_m);
    return std::abs((b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m)) / length;
}

/// Splits where a run is farthest off the line through its ends, until none is far off.
void split(const Run& run, std::size_t first, std::size_t last, std::vector<Run>& pieces) {
    std::size_t farthest = first;
    double most = 1.0;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double off =
            off_line_m(run[first].point(), run[last].point(), run[i].point()) / tolerance_m(run[i]);
        if (off > most) {
            most = off;
            farthest = i;
        }
    }
    if (farthest == first) {
        pieces.emplace_back(run.begin() + static_cast<std::ptrdiff_t>(first),
                            run.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        return;
    }
    split(run, first, farthest, pieces);
    split(run, farthest, last, pieces);
}

struct WallResidual {
    template <class T>
    bool operator()(const T* normal, const T* distance, T* residual) const {
        using std::cos;
        // The distance to the wall, not the range: a grazing beam is no better than others.
        *residual =
            (T(seen.range_m) * cos(T(seen.angle_rad) - *normal) - *distance) / T(tolerance_m(seen));
        return true;
    }

    Seen seen;
};

double angle_between(double a, double b) {
    return std::remainder(a - b, 2.0 * std::acos(-1.0));
}

Wall fitted(const Run& points) {
    const Point a = points.front().point();
    const Point b = points.back().point();
    // Beams go counter-clockwise around the origin, so it is to the left of the way from a to b.
    double normal = std::atan2(-(b.x_m - a.x_m), b.y_m - a.y_m);
    double distance = a.x_m * std::cos(normal) + a.y_m * std::sin(normal);
    ceres::Problem problem;
    auto* const loss = new ceres::CauchyLoss(0.5);
    for (const Seen& seen : points)
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<WallResidual, 1, 1, 1>(new WallResidual{seen}), loss,
            &normal, &distance);
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    Wall wall{.normal_rad = normal, .distance_m = distance};
    wall.first = points.front().beam;
    wall.last = points.back().beam;
    double squares = 0.0;
    for (const Seen& seen : points) {
        const double off = seen.range_m * std::cos(seen.angle_rad - normal) - distance;
        squares += off * off / static_cast<double>(points.size());
    }
    wall.deviation_mm = std::sqrt(squares) / m_per_mm;
    return wall;
}

/// Whether one line is near enough to all points of both.
bool are_one(const Run& a, const Run& b) {
    Run both = a;
    both.insert(both.end(), b.begin(), b.end());
    const Wall wall = fitted(both);
    return std::ranges::all_of(both, [&](const Seen& seen) {
        return std::abs(seen.range_m * std::cos(seen.angle_rad - wall.normal_rad) -
                        wall.distance_m) < tolerance_m(seen);
    });
}

std::vector<Run> merged(const std::vector<Run>& pieces) {
    std::vector<Run> whole;
    for (const Run& piece : pieces) {
        if (!whole.empty() && are_one(whole.back(), piece))
            whole.back().insert(whole.back().end(), piece.begin(), piece.end());
        else
            whole.push_back(piece);
    }
    return whole;
}

/// How far what some neighbouring beams see lies beyond the wall that was laid through all, at most.
bool bends(const Run& points, const Wall& wall) {
    constexpr std::size_t neighbours = 8;
    constexpr double flat_m = 0.0006;
    for (std::size_t i = 0; i + neighbours <= points.size(); i += neighbours / 2) {
        double off_m = 0.0;
        double deviation_m = 0.0;
        for (std::size_t k = i; k < i + neighbours; ++k) {
            off_m += (points[k].range_m - wall.range_m(points[k].angle_rad)) / neighbours;
            deviation_m += points[k].deviation_m / neighbours;
        }
        // Neighbours share a part of their noise.
        const double of_mean_m = deviation_m * std::sqrt(2.0 / neighbours);
        if (std::abs(off_m) > flat_m + 3.0 * of_mean_m) return true;
    }
    return false;
}

/// A wall that bends, or that the scanner sees bent, is several planes.
void add_planes(const Run& points, std::vector<std::pair<Wall, Run>>& planes) {
    constexpr std::size_t least_beams_of_half = 12;
    const Wall wall = fitted(points);
    if (points.size() < 2 * least_beams_of_half || !bends(points, wall)) {
        planes.emplace_back(wall, points);
        return;
    }
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    add_planes({points.begin(), middle}, planes);
    add_planes({middle, points.end()}, planes);
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

/// Whether the two meet where their beams do; then they end there.
bool join_corner(Wall& a, Wall& b, double beam_rad) {
    const auto corner = meeting_of(a, b);
    if (!corner) return false;
    const double room_m = 0.03 + 4.0 * beam_rad * std::hypot(corner->x_m, corner->y_m);
    const auto near = [&](const Point& end) {
        return std::hypot(end.x_m - corner->x_m, end.y_m - corner->y_m) < 3.0 * room_m;
    };
    if (!near(a.end) || !near(b.begin)) return false;
    a.end = b.begin = *corner;
    return true;
}

/// How much of the beams between two walls falls on the first one, in beams: those that an edge
/// mixes lie between both.
double beams_on_first(const Wall& a, const Wall& b, const Readings& readings,
                      const std::vector<Beam>& beams) {
    double sum = 0.0;
    for (std::size_t step = a.last + 1; step < b.first; ++step) {
        const double angle_rad = readings.angle_rad(step);
        const double apart_m = b.range_m(angle_rad) - a.range_m(angle_rad);
        const double seen_m = beams[step].mean_mm * m_per_mm;
        const double share = (b.range_m(angle_rad) - seen_m) / apart_m;
        sum += beams[step].count > 0 ? std::clamp(share, 0.0, 1.0) : 0.5;
    }
    return sum;
}

/// The nearer one ends within the beams between them, and the farther one goes on behind it.
void end_at_edge(Wall& a, Wall& b, const Readings& readings, const std::vector<Beam>& beams) {
    constexpr double hidden_beams = 3.0;
    const double last = static_cast<double>(a.last) + 0.5 + beams_on_first(a, b, readings, beams);
    const double edge_rad = readings.first_rad + readings.beam_rad * last;
    const double hidden_rad = hidden_beams * readings.beam_rad;
    const bool a_is_nearer = a.range_m(edge_rad) < b.range_m(edge_rad);
    a.end = at(a, a_is_nearer ? edge_rad : edge_rad + hidden_rad);
    b.begin = at(b, a_is_nearer ? edge_rad - hidden_rad : edge_rad);
}

void join(std::vector<Wall>& walls, const Readings& readings, const std::vector<Beam>& beams) {
    constexpr std::size_t most_between = 4;
    for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
        Wall& a = walls[i];
        Wall& b = walls[i + 1];
        if (b.first - a.last > most_between) continue;
        if (!join_corner(a, b, readings.beam_rad)) end_at_edge(a, b, readings, beams);
    }
}

/// Where a beam meets a wall between its ends.
double first_range_m(const std::vector<Wall>& walls, double angle_rad) {
    double nearest = std::numeric_limits<double>::infinity();
    const double x = std::cos(angle_rad);
    const double y = std::sin(angle_rad);
    for (const Wall& wall : walls) {
        const double dx = wall.end.x_m - wall.begin.x_m;
        const double dy = wall.end.y_m - wall.begin.y_m;
        const double cross = x * dy - y * dx;
        if (cross == 0.0) continue;
        const double range = (wall.begin.x_m * dy - wall.begin.y_m * dx) / cross;
        const double share = (wall.begin.x_m * y - wall.begin.y_m * x) / cross;
        if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
    }
    return nearest;
}

}  // namespace

double Wall::range_m(double angle_rad) const {
    return distance_m / std::cos(angle_rad - normal_rad);
}

std::vector<Wall> walls_of(const Readings& readings, const Station& station) {
    std::vector<std::pair<Wall, Run>> planes;
    for (const Run& run : runs_of(readings, station)) {
        std::vector<Run> pieces;
        if (run.size() >= least_beams) split(run, 0, run.size() - 1, pieces);
        for (const Run& piece : merged(pieces)) {
            if (piece.size() >= least_beams) add_planes(piece, planes);
        }
    }
    std::vector<Wall> walls;
    for (auto& [wall, points] : planes) {
        // Where the scanner looks no farther, walls go on.
        const auto beyond = [&](bool at_rim) { return (at_rim ? 3.0 : 0.5) * readings.beam_rad; };
        const bool is_last = wall.last + 1 == station.beams.size();
        wall.begin = at(wall, points.front().angle_rad - beyond(wall.first == 0));
        wall.end = at(wall, points.back().angle_rad + beyond(is_last));
        walls.push_back(wall);
    }
    join(walls, readings, station.beams);
    return walls;
}

RoomCheck check_room(const std::vector<Wall>& walls, const Readings& readings,
                     const Station& station) {
    constexpr double most_mm = 30.0;
    RoomCheck check;
    std::vector<double> off;
    for (std::size_t beam = 0; beam < station.beams.size(); ++beam) {
        if (!station.beams[beam].still) continue;
        ++check.beams;
        const double range_m = first_range_m(walls, readings.angle_rad(beam));
        const double apart = std::abs(station.beams[beam].mean_mm - range_m / m_per_mm);
        if (apart < most_mm) off.push_back(apart);
    }
    check.explained = off.size();
    if (off.empty()) return check;
    for (const double one : off)
        check.rms_mm += one * one / static_cast<double>(off.size());
    check.rms_mm = std::sqrt(check.rms_mm);
    std::ranges::sort(off);
    check.worst_of_95_mm = off[off.size() * 95 / 100];
    return check;
}

}  // namespace scipd::tools
