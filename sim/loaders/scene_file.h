// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world from a file of any kind that we read, in a child process. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "sim/loaders/confined_scene.h"
#include "sim/loaders/map/ros_map.h"
#include "sim/loaders/sdf/sdf.h"

namespace scipd::sim {

/// What the files themselves do not say; each kind takes what concerns it.
struct SceneOptions {
    SdfOptions sdf;  ///< of URDF too
    MapOptions map;
    LoadLimits limits = {};
};

/// The file's extension tells its kind: .sdf, .world and .urdf, .xacro, .yaml and .yml for ROS
/// maps, and those of meshes; a .world that is no XML is one of Stage, and .xml is MVSim's. Throws
/// LoadError.
LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace scipd::sim
