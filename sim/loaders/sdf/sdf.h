// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads SDF worlds, SDF models and URDF robots as scenes. Any thread; nothing shared.
//
// A model of the world moves as one body, with everything in it and with all joints at zero. A
// model inside a static one is part of it, unless it says <static>false</static> itself: a door in
// a house, for example, moves as HOUSE::DOOR. scipd ignores lights, plugins and physics; of sensors
// it keeps the poses, and of lidars also the figures. If something visible cannot be read, a
// warning names it and its place, and only the visual, link or model that holds it is left out. If
// Gazebo Classic saved the world, its <state> says where things lie.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// Loads a world, a model, a robot, or the folder of a model. Throws LoadError if the file cannot
/// be used; it never returns a scene that is loaded in part because of a fault.
LoadedScene load_sdf(const std::filesystem::path& file, const SdfOptions& options = {});

/// Loads a text: a whole document, or a <model> or <robot> alone. Relative URIs start at `folder`;
/// messages call the text `name`.
LoadedScene load_sdf_text(const std::string& text, const std::string& name,
                          const std::filesystem::path& folder, const SdfOptions& options = {});

}  // namespace scipd::sim
