// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/drive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "tools/analysis/scan_table.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

/// What lasers of SICK say of where they meet nothing begins here, as in logs of CARMEN.
constexpr double farthest_m = 80.0;
/// The robot itself.
constexpr double nearest_m = 0.05;

/// The first echo; NaN: no distance.
double range_m_of(const sim::RecordedScan& scan, std::size_t step,
                  const sim::ScannerIdentity& laser) {
    return reading_at(scan, step, Echo::first, laser).range_mm * 1e-3;
}

DriveScan scan_of(const sim::RecordedScan& recorded, const sim::ScannerIdentity& laser,
                  double max_range_m) {
    const double first_rad = *recorded.directions.first_rad;
    const double beam_rad = *recorded.directions.increment_rad;
    DriveScan scan{.pose = *recorded.pose, .seen = {}};
    for (std::size_t step = 0; step < recorded.steps(); ++step) {
        const double range_m = range_m_of(recorded, step, laser);
        if (!(range_m > nearest_m && range_m < max_range_m)) continue;
        const double angle_rad = first_rad + beam_rad * static_cast<double>(step);
        scan.seen.push_back({range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)});
    }
    return scan;
}

/// Some logs tell one and the same largest range wherever nothing was met, and do not say so. No
/// wall is the farthest to a hair again and again.
double end_of_ranges_m(const std::vector<sim::RecordedScan>& scans,
                       const sim::ScannerIdentity& laser) {
    constexpr std::size_t chance = 200;  // one of so many readings is more than that
    std::size_t readings = 0;
    std::size_t times = 0;
    double most_m = 0.0;
    for (const sim::RecordedScan& scan : scans) {
        readings += scan.steps();
        for (std::size_t step = 0; step < scan.steps(); ++step) {
            const double m = range_m_of(scan, step, laser);
            if (!(m >= most_m && m < farthest_m)) continue;
            times = m > most_m ? 1 : times + 1;
            most_m = m;
        }
    }
    return times > 10 && times * chance > readings ? most_m : farthest_m;
}

}  // namespace

LaserPose compose(const LaserPose& outer, const LaserPose& pose) {
    const Point at = placed(outer, {pose.x_m, pose.y_m});
    return {at.x_m, at.y_m, outer.yaw_rad + pose.yaw_rad};
}

LaserPose relative(const LaserPose& from, const LaserPose& pose) {
    const Point ahead =
        placed({0.0, 0.0, -from.yaw_rad}, {pose.x_m - from.x_m, pose.y_m - from.y_m});
    return {ahead.x_m, ahead.y_m, pose.yaw_rad - from.yaw_rad};
}

Point placed(const LaserPose& pose, const Point& seen) {
    const double c = std::cos(pose.yaw_rad);
    const double s = std::sin(pose.yaw_rad);
    return {pose.x_m + c * seen.x_m - s * seen.y_m, pose.y_m + s * seen.x_m + c * seen.y_m};
}

Drive read_drive(const std::filesystem::path& file, const std::string& stream) {
    const auto recording = open_recorded(file.string());
    std::vector<sim::RecordedScan> scans;
    Drive drive;
    const auto take = [&](const sim::RecordedScan& scan, const auto&, bool) {
        if (!scan.pose) {
            ++drive.without_place;
            return true;
        }
        if (!scan.directions.first_rad || !scan.directions.increment_rad)
            throw WrongInput(file.string() + ": does not say where the beams look");
        scans.push_back(scan);
        return true;
    };
    const std::size_t chosen = for_each_scan(*recording, file.string(), {.stream = stream}, take);
    const sim::ScannerIdentity& laser = recording->streams()[chosen].identity;
    if (scans.empty())
        throw WrongInput(file.string() +
                         ": does not say where the scanner was; a map needs a drive with the "
                         "laser's poses, such as a log of CARMEN. For a room around a stationary "
                         "scanner: -o room.sdf");
    const double most_m =
        std::min(laser.max_range_m.value_or(end_of_ranges_m(scans, laser)), farthest_m);
    for (const sim::RecordedScan& scan : scans)
        drive.scans.push_back(scan_of(scan, laser, most_m));
    const LaserPose origin = drive.scans.front().pose;
    for (DriveScan& scan : drive.scans)
        scan.pose = relative(origin, scan.pose);
    return drive;
}

}  // namespace scipd::tools
