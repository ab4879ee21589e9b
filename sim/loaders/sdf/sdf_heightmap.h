// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Turns the <heightmap> of an SDF geometry into triangles. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/sdf/part.h"

namespace scipd::sim {

struct Terrain {
    PlacedShape surface;
    std::vector<std::string> remarks;  ///< what a user should know; they name the file
};

/// The surface that Gazebo makes of this file. The corner pixels of the picture are the corners of
/// <size>, centred on <pos>; the top row has the largest y. Between two pixels are <sampling>
/// bilinear steps, and every square is two triangles. Throws LoadError, which names the file.
Terrain terrain_of(const NamedHeights& heights, const std::filesystem::path& file,
                   std::size_t most_triangles);

}  // namespace scipd::sim
