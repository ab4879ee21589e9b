// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Keeps the meshes of one world while it is loaded. Each file is read once, even if the world shows
// it in several places and at several scales. All triangles together must stay within a limit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/mesh/confined_mesh.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/world/shape.h"

namespace scipd::sim {

/// The triangles of one material of a file.
struct SharedPart {
    std::string material;
    SharedMesh mesh;
    Appearance appearance = {};
};

/// How a world shows a mesh.
struct MeshView {
    glm::dvec3 scale{1.0};
    std::string submesh = {};  ///< empty: the whole file
    bool is_centred = false;   ///< the submesh, around its own middle
};

class MeshShelf {
  public:
    /// `limits` hold for each file, but their memory is for all files that are read at one time.
    MeshShelf(std::size_t most_triangles, const MeshLimits& limits)
        : most_triangles_(most_triangles), limits_(limits) {}

    /// Reads the meshes that parts_of() will be asked for, several at a time. parts_of() reports
    /// the faults of a file, and reads alone those files that could not be read together. Call this
    /// while this process is small, since a child begins as a copy of it.
    void read_ahead(const std::vector<MeshSource>& sources);

    /// The parts of this file that `view` shows. Throws LoadError.
    const std::vector<SharedPart>& parts_of(const std::filesystem::path& file,
                                            const MeshView& view);
    /// The mesh that stands in for all that cannot be shown, as `make` makes it the first time.
    /// Throws LoadError as count().
    const SharedMesh& stand_in(const std::function<Mesh()>& make);
    /// Adds the triangles of this shape. Throws LoadError if the world then has too many.
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
        std::size_t memory_bytes;  ///< that the reading may use
    };

    /// Both wait for the outcome, keep it and return the number of its triangles.
    std::size_t take_up(MeshBatch& batch);
    std::size_t take_up(Alone& alone);
    const std::vector<MeshPart>& in_file(const MeshSource& source);

    std::size_t most_triangles_;
    MeshLimits limits_;
    std::size_t triangles_ = 0;
    std::map<MeshSource, InFile> in_file_;
    std::map<Key, std::vector<SharedPart>> parts_;
    SharedMesh stand_in_;
};

}  // namespace scipd::sim
