// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a ROS map as a world: a YAML file and a picture, in the formats of map_server of ROS 1 and
// nav2. Occupied cells become walls between two heights. There is no floor. Any thread; nothing
// shared.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/file/loaded_scene.h"

namespace scipd::sim {

/// What unknown cells become.
enum class UnknownCells {
    free,
    wall,
    unknown,  ///< as high as walls, of a material named unknown
};

/// Settings that a map file does not have.
struct MapOptions {
    double bottom_m = 0.0;  ///< z of the walls in W; below top_m
    double top_m = 2.0;
    std::string material = "wall";
    UnknownCells unknown = UnknownCells::free;

    bool operator==(const MapOptions&) const = default;
};

/// The world has one model, which never moves and has the name of the file. Throws LoadError with
/// every fault.
LoadedScene load_ros_map(const std::filesystem::path& file, const MapOptions& options = {});

}  // namespace scipd::sim
