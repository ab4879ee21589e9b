// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SDF worlds, SDF models and URDF robots into scenes, through libsdformat, which resolves every
// pose. Any thread; nothing shared.
//
// What moves as one body: a model of the world with all that lies in it, joints as they stand at
// zero. A model that lies in a static one is part of it, unless it says <static>false</static>
// itself: a door in a house, movable as HOUSE::DOOR. Lights, plugins and physics are nothing to a
// scanner; of sensors only their places count, and the figures of lidars. What it would see and
// cannot be had is a warning that names it and its place, and costs no more than the visual, link
// or model that has it. The <state> of a world that Gazebo Classic saved says where its things lie.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/loaded_scene.h"
#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {

enum class SdfGeometry { visual, collision };

struct SdfOptions {
    SdfGeometry geometry = SdfGeometry::visual;
    /// Where models are looked for that are nowhere else (resources.h).
    std::vector<std::filesystem::path> model_folders = {};
    /// libsdformat takes about 170 kB for a visual and 2 MB for a model, so that a small file can
    /// be a large world. What would take more than this is refused before it is read.
    std::size_t most_memory_bytes = std::size_t{4} << 30U;
    std::size_t most_triangles = 20'000'000;
    MeshLimits mesh = {};  ///< of each file
    /// Every warning is a fault, and so is what libsdformat has against the parts that are nothing
    /// to a scanner.
    bool strict = false;
};

/// A world, a model or a robot; or the folder of a model. Throws LoadError where the file cannot be
/// used; nothing half-loaded ever leaves.
LoadedScene load_sdf(const std::filesystem::path& file, const SdfOptions& options = {});

/// The same from a text: a whole document, or a <model> or <robot> alone. Relative URIs start at
/// this folder; messages call the text `name`.
LoadedScene load_sdf_text(const std::string& text, const std::string& name,
                          const std::filesystem::path& folder, const SdfOptions& options = {});

}  // namespace scipd::sim
