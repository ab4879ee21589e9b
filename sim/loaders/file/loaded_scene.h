// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "sim/world/scene.h"

namespace scipd::sim {

struct LoadedScene {
    SharedScene scene;
    std::vector<std::string>
        warnings;  ///< each names what was met and what was done about it, once
    std::vector<std::string> notes = {};  ///< worth knowing where nothing is wrong
};

}  // namespace scipd::sim
