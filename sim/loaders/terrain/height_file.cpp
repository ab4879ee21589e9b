// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/terrain/height_file.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::sim {
namespace {

constexpr std::uintmax_t largest_picture_bytes = 1ULL << 29;
constexpr std::array<std::string_view, 5> picture_extensions{".png", ".jpg", ".jpeg", ".pgm",
                                                             ".bmp"};

bool is_picture(const std::filesystem::path& file) {
    return std::ranges::find(picture_extensions, extension_of(file)) != picture_extensions.end();
}

/// As in gz-common 5 (ImageHeightmap.hh, Image::MaxColor()): the red channel gives the heights, and
/// the red of the brightest pixel is as high as <size> says.
template <typename Sample>
HeightGrid grid_of(const MapImage& image, const std::vector<Sample>& samples) {
    HeightGrid grid{.width = image.width, .height = image.height};
    const std::size_t colours = image.channels < 3 ? 1 : 3;
    unsigned brightest = 0;
    Sample highest = 0;
    bool is_coloured = false;
    grid.values.reserve(image.width * image.height);
    for (std::size_t at = 0; at < samples.size(); at += image.channels) {
        const Sample red = samples[at];
        unsigned sum = 0;
        for (std::size_t colour = 0; colour < colours; ++colour) {
            sum += samples[at + colour];
            is_coloured = is_coloured || samples[at + colour] != red;
        }
        if (sum > brightest) highest = red;
        brightest = std::max(brightest, sum);
        grid.values.push_back(static_cast<float>(red) / static_cast<float>(image.white));
    }
    grid.high = static_cast<double>(highest) / image.white;
    if (is_coloured) grid.remarks.emplace_back("is coloured; its red channel gives the heights");
    return grid;
}

HeightGrid read_picture(const std::filesystem::path& file) {
    const auto bytes = read_file(file, largest_picture_bytes, "a picture is wanted here");
    try {
        const MapImage image = read_map_image(bytes);
        return std::visit([&](const auto& samples) { return grid_of(image, samples); },
                          image.samples);
    } catch (const std::invalid_argument& wrong) {
        throw LoadError({file.string() + ": " + wrong.what()});
    }
}

}  // namespace

HeightGrid read_heights(const std::filesystem::path& file) {
    return is_picture(file) ? read_picture(file) : read_dem(file);
}

}  // namespace scipd::sim
