// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Whether it begins as one.
bool is_pgm(std::string_view bytes);

/// P2 and P5 of netpbm, with any maxval. Throws std::invalid_argument.
MapImage read_pgm(std::string_view bytes);

}  // namespace scipd::sim
