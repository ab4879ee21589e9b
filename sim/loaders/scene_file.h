// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a world from a file of any supported kind, or a model. The program scipd-read reads it
// (reader/reader_program.h). Any thread; nothing shared; the caller waits.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/file/load_limits.h"
#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/file/new_model.h"
#include "sim/loaders/map/map_options.h"
#include "sim/loaders/sdf/sdf_options.h"
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

/// The model as a scene of its own, for with_models(). It can be moved unless its file says that it
/// is static. Its limits are a part of those of a world, since models arrive while scanners run,
/// and anybody who can reach the daemon may send one. Throws LoadError, also if the file does not
/// hold exactly one model.
LoadedScene load_model(const NewModel& model, const SceneOptions& options = {});

/// Adds a warning for each material that options.materials does not know; messages begin with
/// `source`. In a strict load all warnings are then a LoadError.
void check_materials(LoadedScene& loaded, const std::string& source, const SceneOptions& options);

/// The folder in which relative paths of things that are added to the world start: the folder of
/// the world's file, or the world itself if it is a folder.
std::filesystem::path folder_of_scene(const std::filesystem::path& file);

}  // namespace scipd::sim
