// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The one function of the module scipd-read-dem.so, which alone links GDAL: with the hundred
// libraries of GDAL any program starts 29 ms later. dem.cpp loads the module where a world has an
// elevation model. One thread.
#pragma once

#include <filesystem>

#include "sim/loaders/terrain/height_grid.h"

namespace scipd::sim {

/// Reads an elevation model. Throws std::exception with what is wrong, in words of the file, too.
extern "C" void scipd_read_dem(const std::filesystem::path& file, HeightGrid& grid);

}  // namespace scipd::sim
