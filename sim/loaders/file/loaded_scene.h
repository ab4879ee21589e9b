// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "sim/world/scene.h"

namespace scipd::sim {

struct LoadedScene {
    SharedScene scene;
    /// Each says what the loader found and what it did about it.
    std::vector<std::string> warnings;
};

}  // namespace scipd::sim
