// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The YAML beside the picture of a ROS map, as map_server of ROS 1 and nav2 read it. Not the
// picture. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace scipd::sim {

/// How the brightness of a pixel becomes an occupancy.
enum class MapMode {
    trinary,  ///< occupied, free, or neither; alpha counts as a colour
    scale,    ///< the same to us, but what is not opaque is unknown
    raw,      ///< the sample is the occupancy in percent; above 100 it is unknown
};

struct MapFile {
    std::filesystem::path image;  ///< absolute where the YAML's own path is
    double resolution_m = 0.05;   ///< the side of a pixel
    glm::dvec2 origin_m{0.0};     ///< in W: the lower left corner of the lower left pixel
    double yaw_rad = 0.0;         ///< about that corner
    MapMode mode = MapMode::trinary;
    bool negate = false;  ///< bright is occupied

    /// Above is occupied, below is free, and what is neither is unknown. Where a file has none,
    /// those of ROS 1: nav2's own 0.25 would make free what its saver writes for unknown, a grey of
    /// 205 (an occupancy of 0.1961).
    double occupied_above = 0.65;
    double free_below = 0.196;

    std::vector<std::string> warnings;
};

/// `file` names the text in faults and is what the image lies beside. Throws LoadError with every
/// fault.
MapFile parse_map_file(const std::string& text, const std::filesystem::path& file);

}  // namespace scipd::sim
