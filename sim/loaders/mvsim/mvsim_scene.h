// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a world file of MVSim: its planes, grids, elevation maps, walls and blocks. Vehicles, and
// blocks that only a 3D model shows, are left out with a warning. Any thread; nothing shared.
#pragma once

#include <filesystem>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/map/ros_map.h"

namespace scipd::sim {

/// The options give occupancy grids the heights that a file does not have. Throws LoadError.
LoadedScene load_mvsim(const std::filesystem::path& file, const MapOptions& options = {});

}  // namespace scipd::sim
