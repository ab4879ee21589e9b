// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Meshes out of a child process, in which mesh_reader.h may do what it will with a file from
// anywhere. Any thread; the caller waits.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/mesh/mesh_reader.h"

namespace scipd::sim {

/// What `read` answers with in the child, which is about to read this file: all of it or, where
/// that fails, what matters of it. Throws LoadError, which names the file: it cannot be a mesh,
/// `read` threw, or the child took too much or crashed.
std::vector<MeshPart> read_confined(const std::filesystem::path& file, const MeshLimits& limits,
                                    const std::function<std::vector<MeshPart>(MeshContents)>& read);

}  // namespace scipd::sim
