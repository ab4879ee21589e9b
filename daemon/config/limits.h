// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a world may take: `limits: {world_memory_mb: 8000, world_triangles: 50000000, world_load_s:
// 900}`. Any thread; nothing shared.
#pragma once

#include "daemon/config/config.h"
#include "daemon/config/section.h"
#include "sim/loaders/scene_file.h"

namespace scipd::daemon {

/// `field` is the value of the root's key `limits`.
WorldLimits read_limits(const Field& field, Faults& faults);

/// To whatever is loaded from now on. One mesh of a world may be as large as all of it; the memory
/// is what libsdformat may take by estimate, and what those that read its meshes may take at a
/// time.
void apply(const WorldLimits& limits, sim::SceneOptions& options);

}  // namespace scipd::daemon
