// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The picture of a ROS map as samples. Not what they mean: that is in occupancy.h. Not the files
// that pictures come in: those are read in map_picture.h. A value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace scipd::sim {

/// Ten kilometres by ten at a metre, 500 m by 500 m at 5 cm.
inline constexpr std::uint64_t most_map_cells = 100'000'000;

/// Rows from the top. A pixel is grey, grey and alpha, RGB or RGBA: as many samples as channels.
struct MapImage {
    std::size_t width = 0;
    std::size_t height = 0;
    unsigned channels = 1;
    unsigned white = 255;  ///< the sample of full light, and of no transparency
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> samples;
};

/// Throws std::invalid_argument where no map can have this size.
void check_map_size(std::uint64_t width, std::uint64_t height);

}  // namespace scipd::sim
