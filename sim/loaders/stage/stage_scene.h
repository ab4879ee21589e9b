// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a world file of Stage. Its models and robots (`position`) stand where they begin, at the
// height that Stage gives them. Robots are movable. A sensor has a body only if the file gives it
// one. There is no floor. Any thread; nothing shared.
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
