// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/mesh_file.h"

namespace scipd::sim {

/// One named thing of a mesh file, in one part for each of its materials.
struct Submesh {
    std::string name;      ///< of its node (OBJ: the object or group) or of its mesh
    bool centred = false;  ///< moved so that the middle of its bounds is the origin
};

/// Otherwise as load_mesh_parts(): where it lies in the file is kept unless it is centred. Throws
/// LoadError, which tells the names that there are.
std::vector<MeshPart> load_submesh(const std::filesystem::path& file, const Submesh& submesh,
                                   const glm::dvec3& scale = {1.0, 1.0, 1.0});

}  // namespace scipd::sim
