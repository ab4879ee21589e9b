// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads materials from a YAML file: `materials: {NAME: {reflectance: {785: 0.9, 905: 0.88},
// ...}}`, as docs/materials.md describes it, and warns of materials of a world that the library
// does not know. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/world/material_library.h"
#include "sim/world/scene.h"

namespace scipd::sim {

/// The entries in the order of the file. Throws LoadError with every fault, each with its line and
/// key; too many faults end it early.
std::vector<MaterialOptics> load_materials(const std::filesystem::path& file);

/// Reads a text as load_materials() does a file. `file` names it in faults.
std::vector<MaterialOptics> parse_materials(const std::string& text,
                                            const std::filesystem::path& file);

/// A warning for each name of a material that the scene uses and the library does not know: what
/// the surfaces are taken as. Each begins with `source`. After 100, one line counts the rest.
std::vector<std::string> unknown_materials(const Scene& scene, const MaterialLibrary& library,
                                           const std::string& source);

/// Returns true if any of those names is not that of a material script of Gazebo's.
bool names_unknown(const Scene& scene, const MaterialLibrary& library);

}  // namespace scipd::sim
