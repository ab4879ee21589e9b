// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a base world becomes the one that many daemons share. Values; any thread.
#pragma once

#include <functional>
#include <vector>

#include "daemon/world/scene_edit.h"
#include "sim/time.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// What makes a base world that of the others.
struct JoinedWorld {
    std::vector<SceneEdit> edits;
    sim::Time age{};  ///< its scripts began so long ago
};

/// Throws std::runtime_error where the base world is not that of the others.
using JoinWorld = std::function<JoinedWorld(const sim::Scene& base)>;

}  // namespace scipd::daemon
