// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/drive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "daemon/recording/decoded_recording.h"
#include "sim/recording/recording_files.h"
#include "tools/options.h"
#include "tools/scipfit/chosen_stream.h"

namespace scipd::tools {
namespace {

/// What lasers of SICK say of where they meet nothing begins here, as in logs of CARMEN.
constexpr double farthest_m = 80.0;
/// The robot itself.
constexpr double nearest_m = 0.05;

double metres(double range, const sim::RecordedScan& scan) {
    return scan.unit == sim::RangeUnit::metres ? range : range * 1e-3;
}

DriveScan scan_of(const sim::RecordedScan& recorded, double max_range_m) {
    const double first_rad = *recorded.directions.first_rad;
    const double beam_rad = *recorded.directions.increment_rad;
    DriveScan scan{.pose = *recorded.pose, .seen = {}};
    for (std::size_t step = 0; step < recorded.steps(); ++step) {
        const auto echoes = recorded.ranges_of(step);
        const double range_m = echoes.empty() ? 0.0 : metres(echoes.front(), recorded);
        if (!(range_m > nearest_m && range_m < max_range_m)) continue;
        const double angle_rad = first_rad + beam_rad * static_cast<double>(step);
        scan.seen.push_back({range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)});
    }
    return scan;
}

/// Some logs tell one and the same largest range wherever nothing was met, and do not say so. No
/// wall is the farthest to a hair again and again.
double end_of_ranges_m(const std::vector<sim::RecordedScan>& scans) {
    constexpr std::size_t chance = 200;  // one of so many readings is more than that
    std::size_t readings = 0;
    std::size_t times = 0;
    double most_m = 0.0;
    for (const sim::RecordedScan& scan : scans) {
        readings += scan.ranges.size();
        for (const double range : scan.ranges) {
            const double m = metres(range, scan);
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
    const auto recording = daemon::open_scans(sim::split_paths(file.string()));
    if (!recording) throw WrongInput(recording.error().why);
    std::vector<sim::RecordedScan> scans;
    std::optional<double> told_m;
    Drive drive;
    const auto take = [&](const sim::RecordedScan& scan, const sim::RecordedStream& laser) {
        if (!scan.pose) {
            ++drive.without_place;
            return;
        }
        if (!scan.directions.first_rad || !scan.directions.increment_rad)
            throw WrongInput(file.string() + ": does not say where the beams look");
        scans.push_back(scan);
        told_m = laser.identity.max_range_m;
    };
    for_each_scan(**recording, file.string(), stream, take);
    if (scans.empty())
        throw WrongInput(file.string() +
                         ": does not say where the scanner was; a map needs a drive with the "
                         "laser's poses, such as a log of CARMEN. For a room around a stationary "
                         "scanner: -o room.sdf");
    const double most_m = std::min(told_m.value_or(end_of_ranges_m(scans)), farthest_m);
    for (const sim::RecordedScan& scan : scans)
        drive.scans.push_back(scan_of(scan, most_m));
    const LaserPose origin = drive.scans.front().pose;
    for (DriveScan& scan : drive.scans)
        scan.pose = relative(origin, scan.pose);
    return drive;
}

}  // namespace scipd::tools
