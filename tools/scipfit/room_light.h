// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How bright each wall of a room is beside the others, and how bright a white one would be by
// range. Intensities tell the product of both, so walls and ranges are fitted together. Values; one
// thread.
#pragma once

#include <optional>
#include <vector>

#include "tools/scipfit/light_fit.h"
#include "tools/scipfit/wall_fit.h"

namespace scipd::tools {

struct RoomLight {
    std::vector<LightAt> white;  ///< by growing range, of a wall that is bright among them
    /// How many times as bright each wall is told to be. Above 1: what sends light back to where it
    /// came from, such as reflective tape.
    std::vector<double> brightness;
};

/// Nothing where there are no intensities.
[[nodiscard]] std::optional<RoomLight> light_in(const std::vector<Wall>& walls,
                                                const ScanTable& readings, const Station& station);

}  // namespace scipd::tools
