// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The heights of a terrain. height_file.h reads them; terrain.h makes triangles of them. A value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

struct HeightGrid {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;  ///< rows from north to south, each from west to east
    /// The range of the values. <size> stretches it upwards from `low`. A picture starts at black,
    /// 0.
    double low = 0.0;
    double high = 1.0;
    /// If the z of <size> is below 0, a point of height z goes to this minus z: 1 for a picture, 0
    /// for an elevation model. Gazebo does the same.
    double top_upside_down_m = 1.0;
    glm::dvec3 size_m{1.0, 1.0, 1.0};  ///< if the world gives none
    std::vector<std::string> remarks;  ///< what a user should know about it
};

}  // namespace scipd::sim
