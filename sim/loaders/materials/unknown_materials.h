// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "sim/world/material_library.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// A warning for each name of a material that the scene uses and the library does not know: what
/// the surfaces are taken as. Each begins with `source`. After 100, one line counts the rest.
std::vector<std::string> unknown_materials(const Scene& scene, const MaterialLibrary& library,
                                           const std::string& source);

/// Whether any of those names is not that of a material script of Gazebo's.
bool names_unknown(const Scene& scene, const MaterialLibrary& library);

}  // namespace scipd::sim
