// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <cstddef>
#include <vector>

#include "sim/backends/range_backend.h"

namespace scipd::tools {

/// Where a robot could stand in a scene: anywhere between its bounds where nothing is nearer than
/// 0.2 m and most beams meet something, at this height, tilted by half a degree or so. The same
/// ones in every run. Throws std::runtime_error where no such place is found.
std::vector<sim::Pose> free_poses(sim::RangeBackend& rays, std::size_t count, double height_m);

}  // namespace scipd::tools
