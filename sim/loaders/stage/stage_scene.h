// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world file of Stage as a world. Its models and robots (position) stand where they begin, as
// high as Stage has them; there is no floor. What moves in Stage by itself, robots, is movable
// here. Sensors have no bodies but those that they are given. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string_view>

#include "sim/loaders/file/loaded_scene.h"

namespace scipd::sim {

/// Whether a .world is one of Stage, and not of Gazebo, which is XML.
bool is_stage(std::string_view text);

/// Throws LoadError.
LoadedScene load_stage(const std::filesystem::path& file);

}  // namespace scipd::sim
