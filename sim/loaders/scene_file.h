// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a world from a file of any supported kind, in a child process. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/confined_scene.h"
#include "sim/loaders/map/ros_map.h"
#include "sim/loaders/sdf/model_fragment.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/world/material_library.h"

namespace scipd::sim {

/// Settings that the files themselves do not have. Each kind of file uses those that apply to it.
struct SceneOptions {
    SdfOptions sdf;  ///< for URDF too
    MapOptions map;
    LoadLimits limits = {};
    /// What is known of materials. Names that it does not know are told; null: none are.
    SharedMaterials materials = nullptr;
    /// Triangles that a ray may be tested against in one place (sim/world/overlap.h).
    std::size_t most_overlap = 1000;
};

/// The extension tells the kind of file: .sdf, .world and .model for SDF, .urdf and .xacro for
/// URDF, .yaml and .yml for ROS maps, .xml for MVSim, and those of meshes (mesh_file.h). A .world
/// that is no XML is a world of Stage. A folder is the folder of a model (model_folder.h). Throws
/// LoadError.
LoadedScene load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

/// Reads the same files as load_scene(), as one model. It starts no child process: call it within
/// load_confined(). Throws LoadError, also if the file does not hold exactly one model.
LoadedScene load_model_file(const std::filesystem::path& file, const Placement& placement,
                            const SceneOptions& options = {});

/// Adds a warning for each material that options.materials does not know; messages begin with
/// `source`. In a strict load all warnings are then a LoadError.
void check_materials(LoadedScene& loaded, const std::string& source, const SceneOptions& options);

/// Throws LoadError, which begins with `source`, where `added` has made a place in the scene in
/// which more triangles lie than a scanner can be let look at. `added` may be the scene itself.
void check_overlap(const Scene& scene, const Scene& added, const std::string& source,
                   const SceneOptions& options);

/// The folder in which relative paths of things that are added to the world start: the folder of
/// the world's file, or the world itself if it is a folder.
std::filesystem::path folder_of_scene(const std::filesystem::path& file);

}  // namespace scipd::sim
