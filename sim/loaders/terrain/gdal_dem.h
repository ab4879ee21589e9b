// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The one function of the module scipd-read-dem.so, which alone links GDAL: a program that has the
// hundred libraries of GDAL takes 29 ms longer to start. dem.cpp loads the module where a world has
// an elevation model. One thread.
#pragma once

#include <filesystem>

#include "sim/loaders/terrain/height_file.h"

namespace scipd::sim {

/// Where the module is if there is one: beside scipd-read, which this program is if it is no test.
std::filesystem::path dem_module();

/// Reads an elevation model. Throws std::exception with what is wrong, in words of the file, too.
extern "C" void scipd_read_dem(const std::filesystem::path& file, HeightGrid& grid);

}  // namespace scipd::sim
