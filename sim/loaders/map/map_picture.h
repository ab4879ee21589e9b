// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the picture of a map: PGM (plain and raw), PNG, BMP, JPEG or TIFF. The header tells how
// large a picture is; one that is too large is refused before any memory is allocated for it. Any
// thread; nothing shared.
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Throws std::invalid_argument, saying what is wrong.
MapImage read_map_image(std::string_view bytes);

// Each kind of picture has a source file of its own. is_KIND() tells whether the bytes begin like
// that kind. read_KIND() reads them and throws std::invalid_argument, saying what is wrong.

/// P2 and P5 of netpbm, with any maxval.
bool is_pgm(std::string_view bytes);
MapImage read_pgm(std::string_view bytes);

/// PNG, and BMP without run-length coding. Palettes become colours; 16-bit samples keep 16 bits.
bool is_stb_picture(std::string_view bytes);
MapImage read_stb_picture(std::string_view bytes);

/// Grey stays grey; everything else becomes RGB.
bool is_jpeg(std::string_view bytes);
MapImage read_jpeg(std::string_view bytes);

/// The first picture of the file. Grey stays grey; palettes become colours; all has 8 bits then.
bool is_tiff(std::string_view bytes);
MapImage read_tiff(std::string_view bytes);

}  // namespace scipd::sim
