// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The <heightmap> of an SDF geometry as triangles. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <sdf/Heightmap.hh>

#include "sim/loaders/sdf/sdf_shape.h"

namespace scipd::sim {

struct Terrain {
    PlacedShape surface;
    std::vector<std::string> remarks;  ///< what a user should know; they name the file
};

/// The surface that Gazebo makes of this file: the pixels in the corners of the picture are the
/// corners of <size>, around <pos>, the top row being the one with the largest y. Between pixels it
/// is bilinear at <sampling> points, each square of which is two triangles. Throws LoadError, which
/// names the file.
Terrain terrain_of(const sdf::Heightmap& heightmap, const std::filesystem::path& file,
                   std::size_t most_triangles);

}  // namespace scipd::sim
