// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads the picture of a ROS map into samples: PGM (plain and raw), PNG, BMP, JPEG or TIFF. The
// header tells its size; a picture that is too large is refused before any memory is allocated for
// it. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
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
