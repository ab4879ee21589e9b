// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads meshes in child processes, so that mesh_reader.h can do no harm with a file from outside.
// Any thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/loaders/file/confined.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_reader.h"

namespace scipd::sim {

/// Several files that one child reads. Each file then costs a third of a child of its own: most of
/// the cost of a child is the memory that it has to be given anew.
class MeshBatch {
  public:
    /// Starts the child.
    MeshBatch(std::vector<MeshSource> sources, const MeshLimits& of_each);

    [[nodiscard]] const std::vector<MeshSource>& sources() const { return sources_; }
    /// The parts of each file, in the file's own coordinates. Waits; call it once. Nothing if any
    /// of the files has a fault. To learn which and what, read each file alone.
    std::optional<std::vector<std::vector<MeshPart>>> outcome();

  private:
    std::vector<MeshSource> sources_;
    std::unique_ptr<Confined> child_;
};

/// Splits the sources into batches for one child each, and keeps their order. A file that does not
/// exist, or is a .gltf, is a batch of its own.
std::vector<std::vector<MeshSource>> batches_of(const std::vector<MeshSource>& sources);

/// How many bytes the child that reads these sources may use; 0 if it is not started, since a file
/// cannot be a mesh.
std::size_t memory_for(const std::vector<MeshSource>& sources, const MeshLimits& limits);

/// One file that a child reads: the whole file or, if that fails, its reduced form (mesh_relief.h).
class MeshReading {
  public:
    /// Starts to read the whole file or, if `submesh` is not empty, the submesh of this name, which
    /// is always read as_in_file.
    MeshReading(std::filesystem::path file, std::string submesh, MeshAxes axes,
                const MeshLimits& limits);

    /// The parts in the file's own coordinates. Waits; call it once. Throws LoadError, which names
    /// the file, if it is no mesh, or if the child took too much or crashed.
    std::vector<MeshPart> parts();

  private:
    void begin(MeshContents contents);
    std::vector<MeshPart> outcome();

    std::filesystem::path file_;
    std::string submesh_;
    MeshAxes axes_;
    MeshLimits limits_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::string why_not_;
    std::unique_ptr<Confined> child_;
};

}  // namespace scipd::sim
