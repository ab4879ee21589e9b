// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Meshes out of child processes, in which mesh_reader.h may do what it will with a file from
// anywhere. Any thread.
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

/// Some files that are being read by one child, which costs a third of a child for each: most of
/// that is memory that each has to be given anew.
class MeshBatch {
  public:
    /// Begins.
    MeshBatch(std::vector<MeshSource> sources, const MeshLimits& of_each);

    [[nodiscard]] const std::vector<MeshSource>& sources() const { return sources_; }
    /// Of each, as they lie in the files. Waits, once. Nothing where anything is wrong with any of
    /// them: what it is, and with which, is told by those who read them alone.
    std::optional<std::vector<std::vector<MeshPart>>> outcome();

  private:
    std::vector<MeshSource> sources_;
    std::unique_ptr<Confined> child_;
};

/// What one child reads in one go. All sources in their order; files that are not there go alone.
std::vector<std::vector<MeshSource>> batches_of(const std::vector<MeshSource>& sources);

/// What the child may take that reads them.
std::size_t memory_for(const std::vector<MeshSource>& sources, const MeshLimits& limits);

/// A file that is being read: all of it or, where that fails, what matters of it.
class MeshReading {
  public:
    /// Begins. All of the file, or its submesh of this name, which is read as_in_file.
    MeshReading(std::filesystem::path file, std::string submesh, MeshAxes axes,
                const MeshLimits& limits);

    /// As they lie in the file. Waits, once. Throws LoadError, which names the file: it cannot be a
    /// mesh, or the child took too much or crashed.
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
