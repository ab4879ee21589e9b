// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the heights of a terrain from a picture or from a digital elevation model. Elevation models
// need GDAL, and a build without it refuses them. Any thread and nothing shared for pictures; the
// single thread of a process for elevation models.
#pragma once

#include <filesystem>

#include "sim/loaders/terrain/height_grid.h"

namespace scipd::sim {

/// Reads a file as a picture if its name ends like one, otherwise as an elevation model. Throws
/// LoadError, which names the file.
HeightGrid read_heights(const std::filesystem::path& file);

/// Reads an elevation model. Throws LoadError, which names the file. The first one loads GDAL into
/// this process and changes its environment, which should have a single thread, as scipd-read has.
HeightGrid read_dem(const std::filesystem::path& file);

}  // namespace scipd::sim
