// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One room that a scanner has seen from several places: the walls of the first station, and where
// the others stand among them. Nobody knows how large the room is. Values; one thread.
#pragma once

#include <optional>
#include <vector>

#include "tools/scipfit/sight.h"
#include "tools/scipfit/wall.h"

namespace scipd::tools {

struct SharedRoom {
    std::vector<Wall> walls;
    std::vector<FlatPose> places;  ///< by station; the first is the origin
    std::vector<bool> placed;      ///< those of other stations see another room

    /// As many as walls.
    [[nodiscard]] std::vector<FaceLine> faces() const;
};

/// Nothing where no other station sees the walls of the first.
[[nodiscard]] std::optional<SharedRoom> shared_room(const Standing& standing);

/// At which wall each beam looks, from these places.
[[nodiscard]] Sights look(const SharedRoom& room, const Standing& standing,
                          const std::vector<FlatPose>& places);

}  // namespace scipd::tools
