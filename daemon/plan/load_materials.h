// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads what is known of the materials of a world. Touches nothing that runs: any thread may do it.
#pragma once

#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "sim/world/material_library.h"

namespace scipd::daemon {

struct LoadedMaterials {
    sim::SharedMaterials library;
    std::vector<std::string> warnings;
};

/// The library that comes with scipd, to which the file adds that the configuration names, and
/// whose entries it replaces. Where the first is not installed, that is a warning, and a fault in a
/// strict configuration. Throws sim::LoadError with every fault of either file.
LoadedMaterials load_materials(const Config& config);

/// "34 (84 % of 178 numbers assumed)"
std::string summary_of(const sim::MaterialLibrary& library);

}  // namespace scipd::daemon
