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

#include <filesystem>
#include <string>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// A world, a model or a robot; or the folder of a model. Throws LoadError where the file cannot be
/// used; nothing half-loaded ever leaves.
LoadedScene load_sdf(const std::filesystem::path& file, const SdfOptions& options = {});

/// The same from a text: a whole document, or a <model> or <robot> alone. Relative URIs start at
/// this folder; messages call the text `name`.
LoadedScene load_sdf_text(const std::string& text, const std::string& name,
                          const std::filesystem::path& folder, const SdfOptions& options = {});

}  // namespace scipd::sim
