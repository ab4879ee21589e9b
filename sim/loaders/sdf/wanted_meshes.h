// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which meshes a document will ask for, known before libsdformat makes its large tree of it. A
// guess that spares time: what it misses is read when it is asked for. Any thread.
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

/// In all visuals, or all collisions, below `root`; relative names begin at `folder`.
std::vector<MeshSource> wanted_meshes(const tinyxml2::XMLElement& root,
                                      const std::filesystem::path& folder,
                                      const Resources& resources, SdfGeometry geometry);

}  // namespace scipd::sim
