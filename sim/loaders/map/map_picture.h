// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files that the picture of a map comes in: PGM (plain and raw), PNG, BMP or JPEG. What a
// picture would take is known from its header and refused before anything is allocated for it. Any
// thread; nothing shared.
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Throws std::invalid_argument, saying what is wrong.
MapImage read_map_image(std::string_view bytes);

// Each kind has a source of its own. Of all of them: whether a file begins as one, and what it
// holds, which throws std::invalid_argument.

/// P2 and P5 of netpbm, with any maxval.
bool is_pgm(std::string_view bytes);
MapImage read_pgm(std::string_view bytes);

/// PNG or BMP, but for BMP with run lengths: palettes are resolved, 16 bits kept.
bool is_stb_picture(std::string_view bytes);
MapImage read_stb_picture(std::string_view bytes);

/// Grey stays grey; everything else becomes RGB.
bool is_jpeg(std::string_view bytes);
MapImage read_jpeg(std::string_view bytes);

}  // namespace scipd::sim
