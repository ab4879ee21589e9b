// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads materials from a YAML file: `materials: {NAME: {reflectance: {785: 0.9, 905: 0.88}, ...}}`.
// docs/materials.md tells the format. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/world/material_library.h"

namespace scipd::sim {

/// The entries in the order of the file. Throws LoadError with every fault, each with its line and
/// key; too many faults end it early.
std::vector<MaterialOptics> load_materials(const std::filesystem::path& file);

/// Reads a text as load_materials() does a file. `file` names it in faults.
std::vector<MaterialOptics> parse_materials(const std::string& text,
                                            const std::filesystem::path& file);

}  // namespace scipd::sim
