// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The meshes of one world while it is loaded: each file is read once, however often, how large and
// in how many places it is shown, and all triangles together stay within a limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <sdf/Mesh.hh>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/mesh/confined_mesh.h"
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
    /// `limits` are those of each file; its memory is that of all which are read at a time.
    MeshShelf(std::size_t most_triangles, const MeshLimits& limits)
        : most_triangles_(most_triangles), limits_(limits) {}

    /// What will be asked for, several at a time. What is wrong with one is said when it is asked
    /// for, and files that cannot be read together are read alone then. Best while this process is
    /// small, since a child begins as a copy of it.
    void read_ahead(const std::vector<MeshSource>& sources);

    /// Of this file at the scale and with the submesh that `mesh` asks for. Throws LoadError.
    const std::vector<SharedPart>& parts_of(const std::filesystem::path& file,
                                            const sdf::Mesh& mesh);
    /// Throws LoadError where this shape is one too many.
    void count(const Shape& shape);

  private:
    using Key = std::tuple<MeshSource, double, double, double, bool>;
    using InFile = std::variant<std::vector<MeshPart>, LoadError>;

    struct Alone {
        MeshSource source;
        MeshReading reading;
    };
    struct Running {
        std::variant<MeshBatch, Alone> reading;
        std::size_t memory_bytes;  ///< that it may take
    };

    /// Each answers with the number of its triangles.
    std::size_t take_up(MeshBatch& batch);
    std::size_t take_up(Alone& alone);
    const std::vector<MeshPart>& in_file(const MeshSource& source);

    std::size_t most_triangles_;
    MeshLimits limits_;
    std::size_t triangles_ = 0;
    std::map<MeshSource, InFile> in_file_;
    std::map<Key, std::vector<SharedPart>> parts_;
};

}  // namespace scipd::sim
