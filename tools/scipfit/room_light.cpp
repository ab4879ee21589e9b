// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/room_light.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

namespace scipd::tools {
namespace {

constexpr std::size_t most_knots = 12;
constexpr std::size_t least_beams_of_knot = 24;

/// What one beam sees of a wall.
struct Seen {
    std::size_t wall;
    double range_mm;
    double log_head_on;  ///< of its intensity, if it met the wall head-on: Lambert's law
};

std::vector<Seen> seen_of(const std::vector<Wall>& walls, const ScanTable& readings,
                          const Station& station) {
    std::vector<Seen> seen;
    for (std::size_t wall = 0; wall < walls.size(); ++wall) {
        for (std::size_t step = walls[wall].first; step <= walls[wall].last; ++step) {
            const Beam& beam = station.beams[step];
            if (!beam.inside || beam.intensity <= 0.0) continue;
            const double incidence = std::cos(readings.angle_rad(step) - walls[wall].normal_rad);
            if (incidence <= 0.0) continue;
            seen.push_back({wall, beam.mean_mm, std::log(beam.intensity / incidence)});
        }
    }
    return seen;
}

/// Ranges between which there are as many beams each.
std::vector<double> knots_of(const std::vector<Seen>& seen) {
    std::vector<double> ranges;
    for (const Seen& one : seen)
        ranges.push_back(one.range_mm);
    std::ranges::sort(ranges);
    const std::size_t parts =
        std::clamp<std::size_t>(seen.size() / least_beams_of_knot, 1, most_knots - 1);
    std::vector<double> knots;
    for (std::size_t i = 0; i <= parts; ++i) {
        const double range = ranges[(ranges.size() - 1) * i / parts];
        if (knots.empty() || range > knots.back() + 1.0) knots.push_back(range);
    }
    return knots;
}

/// Between two knots the intensity of a white wall is straight, as in scipd.
struct LightResidual {
    template <class T>
    bool operator()(const T* wall, const T* before, const T* behind, T* residual) const {
        using std::exp;
        using std::log;
        const T white = exp(*before) * T(1.0 - share) + exp(*behind) * T(share);
        *residual = (T(log_head_on) - *wall - log(white)) / T(usual);
        return true;
    }

    static constexpr double usual = 0.03;
    double log_head_on;
    double share;
};

/// Where walls do not overlap in range, nothing else tells walls and ranges apart: a receiver does
/// not change much from one range to the next, and a wall is as bright as others.
struct Little {
    template <class T>
    bool operator()(const T* value, T* residual) const {
        *residual = *value * T(0.1);
        return true;
    }
};
struct LittleChange {
    template <class T>
    bool operator()(const T* before, const T* behind, T* residual) const {
        *residual = (*behind - *before) * T(0.3);
        return true;
    }
};

struct Parameters {
    std::vector<double> log_walls;
    std::vector<double> log_white;
};

void solve(const std::vector<Seen>& seen, const std::vector<double>& knots,
           Parameters& parameters) {
    ceres::Problem problem;
    auto* const loss = new ceres::CauchyLoss(2.0);
    for (const Seen& one : seen) {
        const auto behind = std::ranges::upper_bound(knots, one.range_mm);
        const std::size_t last = knots.size() - 1;
        const auto at = std::min(static_cast<std::size_t>(behind - knots.begin()), last);
        const std::size_t before = at - 1;
        const double share = (one.range_mm - knots[before]) / (knots[at] - knots[before]);
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LightResidual, 1, 1, 1, 1>(
                new LightResidual{one.log_head_on, std::clamp(share, 0.0, 1.0)}),
            loss, &parameters.log_walls[one.wall], &parameters.log_white[before],
            &parameters.log_white[at]);
    }
    for (double& wall : parameters.log_walls)
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Little, 1, 1>(new Little), nullptr,
                                 &wall);
    for (std::size_t i = 1; i < knots.size(); ++i)
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LittleChange, 1, 1, 1>(new LittleChange), nullptr,
            &parameters.log_white[i - 1], &parameters.log_white[i]);
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
}

/// The wall that counts as white: a tenth of the beams at most sees brighter ones. The brightest of
/// all may be a reflector, beside which walls are black.
double log_white_wall(const std::vector<Seen>& seen, const std::vector<double>& log_walls) {
    std::vector<double> by_beam;
    for (const Seen& one : seen)
        by_beam.push_back(log_walls[one.wall]);
    const auto at = by_beam.begin() + static_cast<std::ptrdiff_t>(by_beam.size() * 9 / 10);
    std::ranges::nth_element(by_beam, at);
    return *at;
}

}  // namespace

std::optional<RoomLight> light_in(const std::vector<Wall>& walls, const ScanTable& readings,
                                  const Station& station) {
    if (!readings.has_intensities()) return std::nullopt;
    const std::vector<Seen> seen = seen_of(walls, readings, station);
    if (seen.size() < 2 * least_beams_of_knot) return std::nullopt;
    const std::vector<double> knots = knots_of(seen);
    if (knots.size() < 2) return std::nullopt;
    double mean = 0.0;
    for (const Seen& one : seen)
        mean += one.log_head_on / static_cast<double>(seen.size());
    Parameters parameters{std::vector(walls.size(), 0.0), std::vector(knots.size(), mean)};
    solve(seen, knots, parameters);
    const double white = log_white_wall(seen, parameters.log_walls);
    RoomLight light;
    for (const double wall : parameters.log_walls)
        light.brightness.push_back(std::exp(wall - white));
    for (std::size_t i = 0; i < knots.size(); ++i)
        light.white.push_back(
            {knots[i], std::exp(parameters.log_white[i] + white), seen.size() / knots.size()});
    return light;
}

}  // namespace scipd::tools
