// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world from a file of any kind that we read, in a child process. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "sim/loaders/confined_scene.h"
#include "sim/loaders/map/ros_map.h"
#include "sim/loaders/sdf/model_fragment.h"
#include "sim/loaders/sdf/sdf.h"

namespace scipd::sim {

/// What the files themselves do not say; each kind takes what concerns it.
struct SceneOptions {
    SdfOptions sdf;  ///< of URDF too
    MapOptions map;
    LoadLimits limits = {};
};

/// The file's extension tells its kind: .sdf, .world and .urdf, .xacro, .yaml and .yml for ROS
/// maps, and those of meshes; a .world that is no XML is one of Stage, and .xml is MVSim's. A
/// folder is that of a model (model_folder.h). Throws LoadError.
LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

/// What load_scene() reads, where it is one model, as that model. In no child of its own; calls of
/// load_confined() are what it is for. Throws LoadError.
LoadedScene load_model_file(const std::filesystem::path& file, const Placement& placement,
                            const SceneOptions& options = {});

/// Where relative paths of what a world is given start: the folder that its file lies in, or that
/// is the world.
std::filesystem::path folder_of_scene(const std::filesystem::path& file);

}  // namespace scipd::sim
