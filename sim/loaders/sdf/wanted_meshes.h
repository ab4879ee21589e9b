// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Guesses which meshes a document will ask for, before libsdformat builds its large tree of it. The
// guess saves time; meshes that it misses are read when the loader asks for them. Any thread.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/loaders/mesh/mesh_shelf.h"
#include "sim/loaders/sdf/resources.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace tinyxml2 {
class XMLElement;
}

namespace scipd::sim {

/// The meshes in all visuals, or all collisions, below `root`. Relative names start at `folder`.
std::vector<MeshSource> wanted_meshes(const tinyxml2::XMLElement& root,
                                      const std::filesystem::path& folder,
                                      const Resources& resources, SdfGeometry geometry);

}  // namespace scipd::sim
