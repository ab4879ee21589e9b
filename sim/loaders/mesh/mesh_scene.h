// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

/// Loads a mesh file as a world: one model that never moves and has the name of the file, with an
/// object for every material, z up (MeshAxes::z_up), in metres. Throws LoadError.
LoadedScene load_mesh_scene(const std::filesystem::path& file, const MeshLimits& limits = {});

}  // namespace scipd::sim
