// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/occupancy.h"

#include <span>

namespace scipd::sim {
namespace {

/// One pixel. Grey counts as three equal colours, as it does to map_server's image libraries.
struct Light {
    unsigned colours;
    unsigned alpha;
};

template <typename Sample>
Light light_of(std::span<const Sample> pixel, unsigned white) {
    const bool has_alpha = pixel.size() % 2 == 0;
    const unsigned colours = pixel.size() < 3 ? 3U * pixel[0] : 0U + pixel[0] + pixel[1] + pixel[2];
    return {colours, has_alpha ? pixel.back() : white};
}

class Judge {
  public:
    Judge(const MapFile& map, const MapImage& image)
        : map_(map),
          white_(image.white),
          alpha_is_colour_(map.mode == MapMode::trinary && image.channels % 2 == 0) {}

    [[nodiscard]] Cell cell(Light light) const {
        if (map_.mode == MapMode::raw) return raw_cell(light);
        if (map_.mode == MapMode::scale && light.alpha < white_) return Cell::unknown;
        const unsigned bright = light.colours + (alpha_is_colour_ ? light.alpha : 0);
        const unsigned full = (alpha_is_colour_ ? 4U : 3U) * white_;
        const unsigned occupied = map_.negate ? bright : full - bright;
        return by_thresholds(static_cast<double>(occupied) / full);
    }

  private:
    /// As in nav2, negate has no effect here. nav2's loader passes the percentages on as they are;
    /// its saver applies the thresholds to them, and so does this function.
    [[nodiscard]] Cell raw_cell(Light light) const {
        const unsigned full = 3U * white_;
        const unsigned percent = (2U * 255U * light.colours + full) / (2U * full);
        return percent > 100 ? Cell::unknown : by_thresholds(percent / 100.0);
    }

    [[nodiscard]] Cell by_thresholds(double occupancy) const {
        if (occupancy > map_.occupied_above) return Cell::occupied;
        return occupancy < map_.free_below ? Cell::free : Cell::unknown;
    }

    const MapFile& map_;
    unsigned white_;
    bool alpha_is_colour_;
};

}  // namespace

CellGrid cells_of(const MapImage& image, const MapFile& map) {
    CellGrid grid{image.width, image.height, {}};
    grid.cells.reserve(image.width * image.height);
    const Judge judge{map, image};
    std::visit(
        [&]<typename Sample>(const std::vector<Sample>& samples) {
            const std::span all{samples};
            for (std::size_t row = 0; row < grid.rows; ++row) {
                const std::size_t first = (grid.rows - 1 - row) * grid.columns;
                for (std::size_t column = 0; column < grid.columns; ++column) {
                    const auto pixel =
                        all.subspan((first + column) * image.channels, image.channels);
                    grid.cells.push_back(judge.cell(light_of(pixel, image.white)));
                }
            }
        },
        image.samples);
    return grid;
}

}  // namespace scipd::sim
