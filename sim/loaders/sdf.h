// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SDF worlds (and model files) into scenes, through libsdformat, which resolves every pose. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/world/scene.h"

namespace scipd::sim {

struct LoadedScene {
    SharedScene scene;
    std::vector<std::string>
        warnings;  ///< each names what was met and what was done about it, once
};

/// The visuals of every model. Throws LoadError where the file cannot be used; nothing half-loaded
/// ever leaves.
LoadedScene load_sdf(const std::filesystem::path& file);

}  // namespace scipd::sim
