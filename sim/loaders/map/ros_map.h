// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A ROS map as a world: a YAML file and a picture, as map_server of ROS 1 and nav2 know them, whose
// occupied cells stand as walls between two heights. There is no floor. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>

#include "sim/loaders/file/loaded_scene.h"

namespace scipd::sim {

/// What cells are that the map knows nothing of.
enum class UnknownCells {
    free,
    wall,
    unknown,  ///< as high as walls, of a material named unknown
};

/// What a map does not say.
struct MapOptions {
    double bottom_m = 0.0;  ///< z of the walls in W; below top_m
    double top_m = 2.0;
    std::string material = "wall";
    UnknownCells unknown = UnknownCells::free;

    bool operator==(const MapOptions&) const = default;
};

/// One model that never moves, named as the file. Throws LoadError with every fault.
LoadedScene load_ros_map(const std::filesystem::path& file, const MapOptions& options = {});

}  // namespace scipd::sim
