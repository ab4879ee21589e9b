// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/wall_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <ceres/ceres.h>

#include "tools/scipfit/wall_ends.h"

namespace scipd::tools {
namespace {

constexpr std::size_t least_beams_of_wall = 4;
constexpr double m_per_mm = 1e-3;

/// A beam's middle, seen from above.
struct SeenBeam {
    std::size_t beam;
    double angle_rad;
    double range_m;
    double deviation_m;  ///< of the middle
    bool inside;         ///< it sees nothing of other faces

    [[nodiscard]] Point point() const {
        return {range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
    }
};

using BeamRun = std::vector<SeenBeam>;

/// So far off a line its points may lie: real walls are no planes.
double tolerance_m(const SeenBeam& seen) {
    return 0.012 + 0.002 * seen.range_m;
}

/// Beams in a row that see something, without a jump.
std::vector<BeamRun> runs_of(const ScanTable& readings, const Station& station) {
    constexpr double steepest = 10.0;
    std::vector<BeamRun> runs;
    for (std::size_t beam = 0; beam < station.beams.size(); ++beam) {
        if (!station.beams[beam].still) continue;
        const Beam& of = station.beams[beam];
        const double deviation_mm = std::sqrt(of.variance_mm2 / static_cast<double>(of.count));
        const SeenBeam seen{beam, readings.angle_rad(beam), of.mean_mm * m_per_mm,
                            deviation_mm * m_per_mm, of.inside};
        const SeenBeam* const before = runs.empty() ? nullptr : &runs.back().back();
        const bool goes_on =
            before != nullptr && beam - before->beam <= 2 &&
            std::abs(seen.range_m - before->range_m) <
                steepest * readings.beam_rad() * before->range_m + tolerance_m(seen);
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
void split(const BeamRun& run, std::size_t first, std::size_t last, std::vector<BeamRun>& pieces) {
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

    SeenBeam seen;
};

/// A beam in a corner, or at an edge, is some millimetres off; a wall of few beams has no others.
BeamRun inner_ones(const BeamRun& points) {
    BeamRun inner;
    std::ranges::copy_if(points, std::back_inserter(inner), &SeenBeam::inside);
    return inner.size() < 2 * least_beams_of_wall ? points : inner;
}

Wall fitted(const BeamRun& all) {
    const BeamRun points = inner_ones(all);
    const Point a = points.front().point();
    const Point b = points.back().point();
    // Beams go counter-clockwise around the origin, so it is to the left of the way from a to b.
    double normal = std::atan2(-(b.x_m - a.x_m), b.y_m - a.y_m);
    double distance = a.x_m * std::cos(normal) + a.y_m * std::sin(normal);
    ceres::Problem problem;
    auto* const loss = new ceres::CauchyLoss(0.5);
    for (const SeenBeam& seen : points)
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<WallResidual, 1, 1, 1>(new WallResidual{seen}), loss,
            &normal, &distance);
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_QR;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    Wall wall{.normal_rad = normal, .distance_m = distance};
    wall.first = all.front().beam;
    wall.last = all.back().beam;
    double squares = 0.0;
    for (const SeenBeam& seen : points) {
        const double off = seen.range_m * std::cos(seen.angle_rad - normal) - distance;
        squares += off * off / static_cast<double>(points.size());
    }
    wall.deviation_mm = std::sqrt(squares) / m_per_mm;
    return wall;
}

/// Whether one line is near enough to all points of both.
bool are_one(const BeamRun& a, const BeamRun& b) {
    BeamRun both = a;
    both.insert(both.end(), b.begin(), b.end());
    const Wall wall = fitted(both);
    return std::ranges::all_of(both, [&](const SeenBeam& seen) {
        return std::abs(seen.range_m * std::cos(seen.angle_rad - wall.normal_rad) -
                        wall.distance_m) < tolerance_m(seen);
    });
}

std::vector<BeamRun> merged(const std::vector<BeamRun>& pieces) {
    std::vector<BeamRun> whole;
    for (const BeamRun& piece : pieces) {
        if (!whole.empty() && are_one(whole.back(), piece))
            whole.back().insert(whole.back().end(), piece.begin(), piece.end());
        else
            whole.push_back(piece);
    }
    return whole;
}

/// Whether these neighbouring beams see it elsewhere than the wall that was laid through all.
bool is_off(std::span<const SeenBeam> neighbours, const Wall& wall) {
    constexpr double flat_m = 0.0002;
    constexpr double surely = 2.0;
    const double n = static_cast<double>(neighbours.size());
    double off_m = 0.0;
    double deviation_m = 0.0;
    for (const SeenBeam& seen : neighbours) {
        off_m += (seen.range_m - wall.range_m(seen.angle_rad)) / n;
        deviation_m += seen.deviation_m / n;
    }
    // Neighbours share a part of their noise, so their mean has about twice the variance.
    return std::abs(off_m) > flat_m + surely * deviation_m * std::sqrt(2.0 / n);
}

bool bends(const BeamRun& all, const Wall& wall) {
    const BeamRun points = inner_ones(all);
    const std::size_t neighbours = std::clamp<std::size_t>(points.size() / 6, 6, 16);
    if (points.size() < neighbours) return false;
    const std::size_t last = points.size() - neighbours;
    for (std::size_t i = 0; i < last; i += neighbours / 2) {
        if (is_off(std::span(points).subspan(i, neighbours), wall)) return true;
    }
    return is_off(std::span(points).last(neighbours), wall);
}

/// A wall that bends, or that the scanner sees bent, is several planes.
void add_planes(const BeamRun& points, std::vector<std::pair<Wall, BeamRun>>& planes) {
    constexpr std::size_t least_beams_of_half = 6;
    const Wall wall = fitted(points);
    if (points.size() < 2 * least_beams_of_half || !bends(points, wall)) {
        planes.emplace_back(wall, points);
        return;
    }
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    add_planes({points.begin(), middle}, planes);
    add_planes({middle, points.end()}, planes);
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

std::vector<Wall> walls_of(const ScanTable& readings, const Station& station) {
    std::vector<std::pair<Wall, BeamRun>> planes;
    for (const BeamRun& run : runs_of(readings, station)) {
        std::vector<BeamRun> pieces;
        if (run.size() >= least_beams_of_wall) split(run, 0, run.size() - 1, pieces);
        for (const BeamRun& piece : merged(pieces)) {
            if (piece.size() >= least_beams_of_wall) add_planes(piece, planes);
        }
    }
    std::vector<Wall> walls;
    for (const auto& [wall, points] : planes)
        walls.push_back(wall);
    find_ends(walls, readings, station.beams);
    return walls;
}

RoomCheck check_room(const std::vector<Wall>& walls, const ScanTable& readings,
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
