// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The room that a recording begins to stand in: its walls, how well they explain what was seen, and
// how bright they are. Values; one thread.
#pragma once

#include <optional>
#include <vector>

#include "tools/scipfit/noise_fit.h"
#include "tools/scipfit/room_light.h"
#include "tools/scipfit/wall_fit.h"

namespace scipd::tools {

struct Room {
    std::vector<Wall> walls;
    RoomCheck check;
    std::size_t stations = 0;        ///< of which the room is that of the first
    std::optional<RoomLight> light;  ///< where the recording has intensities
};

/// The room around the station that comes first. Throws WrongInput where the scanner moves all the
/// time, and where no wall is in sight.
[[nodiscard]] Room room_of(const Standing& standing);

}  // namespace scipd::tools
