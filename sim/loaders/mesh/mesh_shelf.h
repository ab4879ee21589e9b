// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The meshes of one world while it is loaded: each file is read once for each scale and submesh,
// however often it is shown, and all triangles together stay within a limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <sdf/Mesh.hh>

#include "sim/loaders/mesh/mesh_file.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// What one file has of one material.
struct SharedPart {
    std::string material;
    SharedMesh mesh;
};

class MeshShelf {
  public:
    MeshShelf(std::size_t most_triangles, const MeshLimits& of_each)
        : most_triangles_(most_triangles), of_each_(of_each) {}

    /// Of this file at the scale and with the submesh that `mesh` asks for. Throws LoadError.
    const std::vector<SharedPart>& parts_of(const std::filesystem::path& file,
                                            const sdf::Mesh& mesh);
    /// Throws LoadError where this shape is one too many.
    void count(const Shape& shape);

  private:
    using Key = std::tuple<std::filesystem::path, double, double, double, std::string, bool>;

    std::size_t most_triangles_;
    MeshLimits of_each_;
    std::size_t triangles_ = 0;
    std::map<Key, std::vector<SharedPart>> parts_;
};

}  // namespace scipd::sim
