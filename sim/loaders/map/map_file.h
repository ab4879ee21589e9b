// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the YAML file of a ROS map, as map_server of ROS 1 and nav2 read it. The picture that it
// names is read in map_picture.h. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace scipd::sim {

/// How the brightness of a pixel becomes an occupancy.
enum class MapMode {
    trinary,  ///< occupied, free, or neither; alpha counts like a colour
    scale,    ///< the same here, but a pixel that is not opaque is unknown
    raw,      ///< the sample is the occupancy in percent; above 100 it is unknown
};

struct MapFile {
    std::filesystem::path image;  ///< absolute if the YAML's own path is
    double resolution_m = 0.05;   ///< the side of a pixel
    glm::dvec2 origin_m{0.0};     ///< in W: the lower left corner of the lower left pixel
    double yaw_rad = 0.0;         ///< about that corner
    MapMode mode = MapMode::trinary;
    bool negate = false;  ///< bright is occupied

    /// A cell is occupied above the first, free below the second, and otherwise unknown. The
    /// defaults are those of ROS 1. With nav2's own 0.25, the grey of 205 (an occupancy of 0.1961)
    /// that its saver writes for unknown would be free.
    double occupied_above = 0.65;
    double free_below = 0.196;

    std::vector<std::string> warnings;
};

/// `file` is the path of the YAML: faults name it, and the image's path is relative to its folder.
/// Throws LoadError with every fault.
MapFile parse_map_file(const std::string& text, const std::filesystem::path& file);

}  // namespace scipd::sim
