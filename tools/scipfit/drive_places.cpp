// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/drive_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scipd::tools {
namespace {

/// More of them place a scan no better, and take longer.
constexpr std::size_t most_beams = 200;

/// How many ends lie on faces, each the less the farther it is from one.
double score(const DriveGrid& grid, const DriveScan& scan, const LaserPose& pose) {
    const std::size_t stride = 1 + scan.seen.size() / most_beams;
    double sum = 0.0;
    for (std::size_t i = 0; i < scan.seen.size(); i += stride) {
        const auto off_m = grid.distance_m(placed(pose, scan.seen[i]));
        if (!off_m) continue;
        const double cells = *off_m / grid.cell_m();
        sum += std::exp(-2.0 * cells * cells) * static_cast<double>(stride);
    }
    return sum;
}

}  // namespace

LaidDrive laid_as_recorded(const std::vector<DriveScan>& drive, double cell_m) {
    LaidDrive laid{.grid = {drive, cell_m}, .places = {}};
    for (const DriveScan& scan : drive) {
        laid.grid.add(scan, scan.pose);
        laid.places.push_back(scan.pose);
    }
    return laid;
}

LaidDrive laid_over_itself(const std::vector<DriveScan>& drive, double cell_m) {
    LaidDrive laid{.grid = {drive, cell_m}, .places = {}};
    for (const DriveScan& scan : drive) {
        LaserPose place = scan.pose;
        if (!laid.places.empty()) {
            const LaserPose moved = relative(drive[laid.places.size() - 1].pose, scan.pose);
            place = laid_over(laid.grid, scan, compose(laid.places.back(), moved));
        }
        laid.grid.add(scan, place);
        laid.places.push_back(place);
    }
    return laid;
}

// It climbs along x, y and yaw, with steps that are halved where none leads higher.
LaserPose laid_over(const DriveGrid& grid, const DriveScan& scan, const LaserPose& start) {
    constexpr double turn_rad = 0.02;
    constexpr double finest = 1.0 / 16.0;
    constexpr double least_share = 0.3;
    constexpr int most_steps = 200;
    LaserPose best = start;
    double highest = score(grid, scan, best);
    double size = 1.0;
    for (int steps = 0; size >= finest && steps < most_steps; ++steps) {
        const double m = size * grid.cell_m();
        const double rad = size * turn_rad;
        bool higher = false;
        for (const LaserPose& step :
             {LaserPose{m, 0, 0}, {-m, 0, 0}, {0, m, 0}, {0, -m, 0}, {0, 0, rad}, {0, 0, -rad}}) {
            const LaserPose next = compose(best, step);
            const double height = score(grid, scan, next);
            if (height <= highest) continue;
            highest = height;
            best = next;
            higher = true;
        }
        if (!higher) size *= 0.5;
    }
    return highest < least_share * static_cast<double>(scan.seen.size()) ? start : best;
}

}  // namespace scipd::tools
