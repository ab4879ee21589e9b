// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The heights of a terrain. Not yet where they lie: that is in sdf_heightmap.h. Not the file that
// they come from: that is read in height_file.h. A value.
#pragma once

#include <cstddef>
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

}  // namespace scipd::sim
