// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as the picture of a ROS map: the result has as many cells as its header says, and they
// form a closed solid, or it is a sentence that can be shown.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/text/quote.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const Mesh& mesh) {
    // Every edge of a closed mesh belongs to an even number of triangles, three edges to each.
    require(mesh.triangles.size() % 2 == 0);
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            require(triangle[i] < mesh.vertices_m.size());
    }
}

void check(const MapImage& image) {
    require(image.width * image.height <= most_map_cells);
    require(image.channels >= 1 && image.channels <= 4);
    if (image.width * image.height > 1'000'000) return;
    for (const auto mode : {MapMode::trinary, MapMode::scale, MapMode::raw}) {
        MapFile map;
        map.mode = mode;
        map.negate = image.width % 2 == 0;
        const CellGrid grid = cells_of(image, map);
        require(grid.columns == image.width && grid.rows == image.height);
        require(grid.cells.size() == image.width * image.height);
        check(wall_mesh(grid, Cell::occupied, {1.0, 0.0, 2.0}));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        check(read_map_image({reinterpret_cast<const char*>(data), size}));
    } catch (const std::invalid_argument& wrong) {
        const std::string_view text = wrong.what();
        require(!text.empty() && text.size() < 400);
        require(scipd::sim::printable(text, text.size()) == text);
    }
    return 0;
}
