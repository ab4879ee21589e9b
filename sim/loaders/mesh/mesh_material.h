// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a mesh file says of its materials, as Assimp tells it. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>

#include <assimp/material.h>
#include <assimp/scene.h>

#include "sim/world/material.h"

namespace scipd::sim {

/// Removes all properties of the scene's materials but those that the functions below read. The
/// importer has no step for this.
void keep_what_matters(const aiScene& scene, const std::filesystem::path& file);

/// Empty where the file gives no name: Assimp makes one up then.
std::string name_of(const aiMaterial& material);

/// Only after keep_what_matters().
Appearance appearance_of(const aiMaterial& material);

}  // namespace scipd::sim
