// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_image.h"

#include <stdexcept>
#include <string>

namespace scipd::sim {

void check_map_size(std::uint64_t width, std::uint64_t height) {
    if (width == 0 || height == 0) throw std::invalid_argument("has no pixels");
    if (width <= most_map_cells && height <= most_map_cells / width) return;
    throw std::invalid_argument("has " + std::to_string(width) + " x " + std::to_string(height) +
                                " pixels; a map has at most 100 million");
}

}  // namespace scipd::sim
