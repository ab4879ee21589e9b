// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The picture of a ROS map as samples. map_picture.h reads it from a file, and occupancy.h tells
// what the samples mean. A value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace scipd::sim {

/// Enough for 10 km by 10 km at 1 m a cell, or for 500 m by 500 m at 5 cm.
inline constexpr std::uint64_t most_map_cells = 100'000'000;

/// Rows from the top. A pixel is grey, grey and alpha, RGB or RGBA: as many samples as channels.
struct MapImage {
    std::size_t width = 0;
    std::size_t height = 0;
    unsigned channels = 1;
    unsigned white = 255;  ///< the sample of full brightness, or of full opacity
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> samples;
};

/// Throws std::invalid_argument if the size is 0 or has more than most_map_cells.
void check_map_size(std::uint64_t width, std::uint64_t height);

}  // namespace scipd::sim
