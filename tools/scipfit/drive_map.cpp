// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/drive_map.h"

#include <algorithm>
#include <cmath>

#include "tools/formatted.h"
#include "tools/options.h"
#include "tools/scipfit/drive_grid.h"
#include "tools/scipfit/drive_places.h"

namespace scipd::tools {
namespace {

DriveMap map_on(const Drive& drive, const LaidDrive& laid) {
    DriveMap map{.map = laid.grid.floor_map(),
                 .scans = drive.scans.size(),
                 .without_place = drive.without_place};
    double squares = 0.0;
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        map.readings += drive.scans[i].seen.size();
        for (const Point& seen : drive.scans[i].seen) {
            const auto off_m = laid.grid.distance_m(placed(laid.places[i], seen));
            if (!off_m || *off_m > 1.5 * laid.grid.cell_m()) continue;
            ++map.explained;
            squares += *off_m * *off_m;
        }
    }
    if (map.explained > 0)
        map.rms_mm = 1000.0 * std::sqrt(squares / static_cast<double>(map.explained));
    return map;
}

double most_moved_m(const std::vector<DriveScan>& drive, const std::vector<LaserPose>& places) {
    double most_m = 0.0;
    for (std::size_t i = 0; i < drive.size(); ++i) {
        const LaserPose& recorded = drive[i].pose;
        most_m = std::max(most_m,
                          std::hypot(places[i].x_m - recorded.x_m, places[i].y_m - recorded.y_m));
    }
    return most_m;
}

}  // namespace

// Places that a program for maps has corrected close loops, which refining does not. They explain
// nearly as much, and stay.
DriveMap map_of(const Drive& drive, double cell_m) {
    constexpr double nearly = 0.98;
    const std::vector<DriveScan>& scans = drive.scans;
    DriveMap as_recorded = map_on(drive, laid_as_recorded(scans, cell_m));
    const LaidDrive refined = laid_over_itself(scans, cell_m);
    DriveMap as_refined = map_on(drive, refined);
    if (as_refined.explained == 0)
        throw WrongInput(
            "no two beams of this drive end at one place, so no map can be created; are its "
            "poses in metres and radians, and its ranges in metres?");
    if (static_cast<double>(as_recorded.explained) >=
        nearly * static_cast<double>(as_refined.explained))
        return as_recorded;
    as_refined.refined = true;
    as_refined.most_moved_m = most_moved_m(scans, refined.places);
    return as_refined;
}

nlohmann::ordered_json as_json(const DriveMap& map) {
    return {{"scans", map.scans},
            {"without_place", map.without_place},
            {"readings", map.readings},
            {"explained", map.explained},
            {"rms_mm", map.rms_mm},
            {"refined", map.refined},
            {"most_moved_m", map.most_moved_m},
            {"columns", map.map.columns},
            {"rows", map.map.rows},
            {"resolution_m", map.map.resolution_m}};
}

std::string as_text(const DriveMap& map) {
    std::string text = formatted(
        "%zu scans; the map explains %zu of %zu readings, %.0f mm around its faces (rms)\n",
        map.scans, map.explained, map.readings, map.rms_mm);
    if (map.without_place > 0)
        text += formatted("left out, since they do not say where the scanner was: %zu scans\n",
                          map.without_place);
    if (map.explained < map.readings)
        text += formatted("%zu readings end where the map has no face: they are left out\n",
                          map.readings - map.explained);
    constexpr double little = 0.8;
    if (static_cast<double>(map.explained) < little * static_cast<double>(map.readings))
        text += "that is little: are the poses in metres and radians, and do few things move?\n";
    text +=
        map.refined
            ? formatted("the recorded places fit less well: they were refined, by up to %.2f m\n",
                        map.most_moved_m)
            : std::string("the places are those that the recording has\n");
    return text;
}

}  // namespace scipd::tools
