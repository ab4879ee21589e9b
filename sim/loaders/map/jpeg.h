// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string_view>

#include "sim/loaders/map/map_image.h"

namespace scipd::sim {

/// Whether it begins as one.
bool is_jpeg(std::string_view bytes);

/// Grey stays grey; everything else becomes RGB. Throws std::invalid_argument.
MapImage read_jpeg(std::string_view bytes);

}  // namespace scipd::sim
