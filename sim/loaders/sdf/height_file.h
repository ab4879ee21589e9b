// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files that the heights of a terrain come in: pictures, and digital elevation models through
// GDAL where there was one to build with (dem.cpp), which a no_dem.cpp stands in for. Any thread;
// nothing shared.
#pragma once

#include <filesystem>

#include "sim/loaders/sdf/height_grid.h"

namespace scipd::sim {

/// A picture by the end of its name, else an elevation model. Throws LoadError, which names the
/// file.
HeightGrid read_heights(const std::filesystem::path& file);

/// An elevation model. Throws LoadError, which names the file.
HeightGrid read_dem(const std::filesystem::path& file);

}  // namespace scipd::sim
