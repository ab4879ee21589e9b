// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How far a world reaches, as it is loaded. Values; any thread.
#pragma once

#include "sim/world/bounds.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// The box around an object, in W.
Bounds bounds_in_world(const Scene& scene, const Object& object);

/// The box around all of them; empty where there are none.
Bounds extent_of(const Scene& scene);

}  // namespace scipd::sim
