// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world as one binary glTF 2.0 file (GLB), with the names of objects and materials. Any thread.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/export/placed_mesh.h"

namespace scipd::sim {

/// How a material looks: a grey of 0 to 1, and how much of what is behind shows through.
struct ExportedLook {
    double grey = 0.7;
    double transparency = 0.0;
};

/// The bytes of the file. Its frame has y up, as glTF demands: the outermost node turns the z of
/// the world there. Objects that share triangles share a mesh. A material that `looks` does not
/// know looks like the default.
std::string glb_of(const std::vector<PlacedMesh>& meshes, const std::string& name,
                   const std::map<std::string, ExportedLook>& looks);

}  // namespace scipd::sim
