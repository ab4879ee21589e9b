// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/room_fit.h"

#include <algorithm>

#include "tools/options.h"

namespace scipd::tools {

Room room_of(const Standing& standing) {
    const ScanTable& readings = *standing.readings;
    if (standing.stations.empty())
        throw WrongInput(readings.files +
                         ": the scanner moves all the time; record a stationary one, or create a "
                         "map of a drive that has the laser's poses: -o room.yaml");
    const Station& station = *std::ranges::min_element(standing.stations, {}, &Station::first);
    Room room{.walls = walls_of(readings, station),
              .check = {},
              .stations = standing.stations.size(),
              .light = {}};
    if (room.walls.empty())
        throw WrongInput(readings.files + ": no wall is in sight, so there is no room to make");
    room.check = check_room(room.walls, readings, station);
    room.light = light_in(room.walls, readings, station);
    return room;
}

}  // namespace scipd::tools
