// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Builds a scene from what libsdformat has read. Any thread; nothing shared.
#pragma once

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_file.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// `read` must have no faults. `source` is its file, for messages; `shelf` holds the meshes. Throws
/// LoadError.
LoadedScene scene_of(SdfFile read, const std::filesystem::path& source, const Resources& resources,
                     const SdfOptions& options, MeshShelf& shelf);

}  // namespace scipd::sim
