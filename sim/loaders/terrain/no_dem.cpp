// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands in for dem.cpp in a build without GDAL.
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/terrain/height_file.h"

namespace scipd::sim {

HeightGrid read_dem(const std::filesystem::path& file) {
    const auto plain = check_plain_file(file);
    throw LoadError({file.string() + ": " +
                     (plain ? "is no picture, and this scipd was built without GDAL, which reads "
                              "elevation models; build it where libgdal-dev is installed, or "
                              "convert the file with `gdal_translate -of PNG -ot UInt16 -scale` "
                              "and name the PNG"
                            : plain.error().why + "; a terrain is wanted here")});
}

}  // namespace scipd::sim
