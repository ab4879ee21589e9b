// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner reads too far, by faces whose ranges are known: those of a world, or those of a
// room that it has seen from several places. Values; one thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/scipfit/known_length.h"
#include "tools/scipfit/known_world.h"
#include "tools/scipfit/place_knowledge.h"
#include "tools/scipfit/shared_room.h"
#include "tools/scipfit/unknown.h"

namespace scipd::tools {

struct Calibration {
    bool by_world = false;  ///< else by several stations of one room
    std::vector<BiasAt> curve;
    bool but_for_slope = false;  ///< the curve may have any slope, since the room may have any size
    /// Which straight line the curve is, if it is one, and as far as that is known.
    std::optional<Interval> offset_mm;       ///< at the range 0
    std::optional<Interval> scale_mm_per_m;  ///< its slope
    /// Where the scanner stood, by station, as far as that is known; in a world.
    std::vector<std::optional<PlaceAt>> places;
    std::size_t stations = 0;
    std::size_t beams = 0;
    double spread_mm = 0.0;  ///< of the beams around all that
    PlaceFit fit;
    std::vector<Sight> sights;  ///< what it was fitted to
    Unknowns unknown;
};

/// What a fit needs to tell the offset in a room that nobody has measured.
inline constexpr const char* what_tells_the_offset =
    "three stations or more in one room, a metre apart, each turned by less than 90 degrees";

/// How well a scanner's place is measured by hand.
inline constexpr PlaceError by_hand{.mm = 10.0, .yaw_rad = 0.0175};

/// `places`: by station. Throws WrongInput where the world does not look like that from there.
[[nodiscard]] Calibration calibrate_in(KnownWorld& world, const Standing& standing,
                                       const std::vector<FlatPose>& places);

/// The room itself is fitted, too: it may have any size.
[[nodiscard]] Calibration calibrate_in(const SharedRoom& room, const Standing& standing);

}  // namespace scipd::tools
