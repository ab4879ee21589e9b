// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The picture of a ROS map: PGM (plain and raw), PNG, BMP or JPEG, as samples. Not what they mean:
// that is in occupancy.h. What an image would take is known from its header and refused before
// anything is allocated for it. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
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

/// Throws std::invalid_argument, saying what is wrong.
MapImage read_map_image(std::string_view bytes);

/// Throws std::invalid_argument where no map can have this size.
void check_map_size(std::uint64_t width, std::uint64_t height);

}  // namespace scipd::sim
