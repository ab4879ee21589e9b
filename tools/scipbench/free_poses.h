// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstddef>
#include <vector>

#include "sim/backends/range_backend.h"

namespace scipd::tools {

/// Poses where a robot could stand in a scene: between its bounds, at this height, with nothing
/// nearer than 0.2 m, where most beams hit something. They are tilted by about half a degree. Every
/// run gets the same ones. Throws std::runtime_error if it finds none.
std::vector<sim::Pose> free_poses(sim::RangeBackend& rays, std::size_t count, double height_m);

}  // namespace scipd::tools
