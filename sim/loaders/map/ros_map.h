// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a ROS map as a world: a YAML file and a picture, in the formats of map_server of ROS 1 and
// nav2. Occupied cells become walls between two heights. There is no floor. Any thread; nothing
// shared.
#pragma once

#include <filesystem>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/map/map_options.h"

namespace scipd::sim {

/// The world has one model, which never moves and has the name of the file. Throws LoadError with
/// every fault.
LoadedScene load_ros_map(const std::filesystem::path& file, const MapOptions& options = {});

}  // namespace scipd::sim
