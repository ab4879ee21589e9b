// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The heights of a terrain from a file: a picture, or a digital elevation model. Not yet where they
// lie: that is in sdf_heightmap.h. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

struct HeightGrid {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;  ///< rows from the north, each from the west
    /// Of the values, which <size> spreads from `low` upwards. A picture counts from black.
    double low = 0.0;
    double high = 1.0;
    /// With a <size> below 0, what is z high lies at this less z: 1 for a picture, 0 for a model of
    /// elevations. Sic, in Gazebo.
    double top_upside_down_m = 1.0;
    glm::dvec3 size_m{1.0, 1.0, 1.0};  ///< where a world gives none
    std::vector<std::string> remarks;  ///< what a user should know of it
};

/// A picture by the end of its name, else an elevation model. Throws LoadError, which names the
/// file.
HeightGrid read_heights(const std::filesystem::path& file);

}  // namespace scipd::sim
