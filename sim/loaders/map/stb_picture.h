// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Whether it begins as a PNG or BMP.
bool is_stb_picture(std::string_view bytes);

/// Either, but for BMP with run lengths: palettes are resolved, 16 bits kept. Throws
/// std::invalid_argument.
MapImage read_stb_picture(std::string_view bytes);

}  // namespace scipd::sim
