// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Whether it begins as one.
bool is_png(std::string_view bytes);

/// Any PNG: palettes are resolved, 16 bits kept. Throws std::invalid_argument.
MapImage read_png(std::string_view bytes);

}  // namespace scipd::sim
