// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_picture.h"

#include <stdexcept>

#include "sim/loaders/file/mistaken_file.h"

namespace scipd::sim {

MapImage read_map_image(std::string_view bytes) {
    if (is_stb_picture(bytes)) return read_stb_picture(bytes);
    if (is_jpeg(bytes)) return read_jpeg(bytes);
    if (is_tiff(bytes)) return read_tiff(bytes);
    if (is_pgm(bytes)) return read_pgm(bytes);
    if (const auto why = why_mistaken(bytes, "picture"); !why.empty()) {
        throw std::invalid_argument(why);
    }
    throw std::invalid_argument("is no PGM, PNG, BMP, JPEG or TIFF; save the map as one of these");
}

}  // namespace scipd::sim
