// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the heights of a terrain from a picture or from a digital elevation model. Elevation models
// need GDAL, and a build without it refuses them. Any thread and nothing shared for pictures; the
// single thread of a process for elevation models.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace scipd::sim {

/// The heights of a terrain; terrain.h makes triangles of them.
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

/// Reads a file as a picture if its name ends like one, otherwise as an elevation model. Throws
/// LoadError, which names the file.
HeightGrid read_heights(const std::filesystem::path& file);

/// Reads an elevation model. Throws LoadError, which names the file. The first one loads GDAL into
/// this process and changes its environment, which should have a single thread, as scipd-read has.
HeightGrid read_dem(const std::filesystem::path& file);

}  // namespace scipd::sim
