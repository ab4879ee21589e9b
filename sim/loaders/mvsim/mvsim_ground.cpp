// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_ground.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

double resolution_m(const MvsimNode& node, double otherwise_m) {
    const double said_m = node.number("resolution", otherwise_m);
    if (said_m >= 1e-4 && said_m <= 1e3) return said_m;
    throw std::invalid_argument("<resolution> must be within 0.0001 and 1000 m a pixel");
}

glm::dvec3 checked(const glm::dvec3& xyz_m) {
    if (plausible_position(xyz_m)) return xyz_m;
    throw std::invalid_argument("must lie within 1e7 m of the origin");
}

/// The mean of the colours, from 0 to 1.
std::vector<float> greys_of(const MapImage& image) {
    std::vector<float> greys;
    greys.reserve(image.width * image.height);
    const unsigned colours = image.channels < 3 ? 1 : 3;
    std::visit(
        [&](const auto& samples) {
            for (std::size_t first = 0; first < samples.size(); first += image.channels) {
                float sum = 0.0F;
                for (unsigned i = 0; i < colours; ++i)
                    sum += static_cast<float>(samples[first + i]);
                greys.push_back(sum / static_cast<float>(colours * image.white));
            }
        },
        image.samples);
    return greys;
}

/// Cells are cut along the diagonal from their corner of the least x and y.
void add_cells(std::size_t rows, std::size_t columns, Mesh& mesh) {
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto here = static_cast<glm::uint>(row * columns + column);
            const auto next = static_cast<glm::uint>(here + columns);
            mesh.triangles.emplace_back(here, here + 1, next + 1);
            mesh.triangles.emplace_back(here, next, next + 1);
        }
    }
}

/// Row after row.
struct Heights {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> all_m;
};

void append_row(std::string_view row, Heights& heights) {
    constexpr auto blanks = " \t\r\n,";
    const std::size_t before = heights.all_m.size();
    for (auto begin = row.find_first_not_of(blanks); begin != row.npos;
         begin = row.find_first_not_of(blanks)) {
        row.remove_prefix(begin);
        const std::string_view word = row.substr(0, row.find_first_of(blanks));
        row.remove_prefix(word.size());
        const auto number = parse_number(word.starts_with('+') ? word.substr(1) : word);
        if (!number) {
            throw std::invalid_argument("<elevation_data_matrix> wants numbers, not " +
                                        quote(word));
        }
        heights.all_m.push_back(static_cast<float>(*number));
    }
    const std::size_t columns = heights.all_m.size() - before;
    if (columns == 0) return;
    if (heights.rows++ == 0) heights.columns = columns;
    if (columns != heights.columns) {
        throw std::invalid_argument("<elevation_data_matrix> has rows of " +
                                    std::to_string(heights.columns) + " and of " +
                                    std::to_string(columns) + " numbers");
    }
}

/// Reads a matrix as Matlab writes it: [1 0 2; 0 4 -1].
Heights heights_in(std::string_view text) {
    text = trimmed(text);
    if (!text.starts_with('[') || !text.ends_with(']')) {
        throw std::invalid_argument(
            "<elevation_data_matrix> must be in brackets, its rows divided by semicolons: "
            "[0 0; 1 1]");
    }
    text.remove_prefix(1);
    text.remove_suffix(1);
    Heights heights;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        append_row(text.substr(0, end), heights);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return heights;
}

PlacedMesh terrain(const MvsimNode& map, const Heights& heights) {
    constexpr std::size_t most_cells = 10'000'000;
    const auto& [rows, columns, all_m] = heights;
    if (rows < 2 || columns < 2 || all_m.size() > most_cells) {
        throw std::invalid_argument("wants heights of 2 x 2 to 10 million places");
    }
    const double cell_m = resolution_m(map, 1.0);
    Mesh mesh;
    for (std::size_t i = 0; i < all_m.size(); ++i) {
        mesh.vertices_m.emplace_back(cell_m * double(i / columns), cell_m * double(i % columns),
                                     all_m[i]);
    }
    add_cells(rows, columns, mesh);
    const glm::dvec2 span_m = cell_m * glm::dvec2{rows - 1, columns - 1};
    const auto [lowest_m, highest_m] = std::ranges::minmax(all_m);
    checked({span_m, highest_m});
    checked({span_m, lowest_m});
    return {std::move(mesh), checked({map.number("corner_min_x", -0.5 * span_m.x),
                                      map.number("corner_min_y", -0.5 * span_m.y), 0.0})};
}

}  // namespace

PlacedMesh grid_mesh(const MvsimNode& grid, std::string_view picture, double bottom_m,
                     double top_m) {
    MapFile map;
    map.mode = MapMode::scale;
    map.resolution_m = resolution_m(grid, 0.1);
    map.occupied_above = 0.5;
    map.free_below = 0.5;
    const CellGrid cells = cells_of(read_map_image(picture), map);
    const double columns = static_cast<double>(cells.columns);
    const double rows = static_cast<double>(cells.rows);
    const glm::dvec2 origin{grid.number("centerpixel_x", 0.5 * columns),
                            grid.number("centerpixel_y", 0.5 * rows)};
    const glm::dvec2 middle_m = map.resolution_m * (0.5 * glm::dvec2{columns, rows} - origin);
    Mesh mesh = wall_mesh(cells, Cell::occupied, {map.resolution_m, bottom_m, top_m});
    return {std::move(mesh), checked({middle_m, 0.0})};
}

PlacedMesh elevation_mesh(const MvsimNode& map, std::string_view picture) {
    const MapImage image = read_map_image(picture);
    const double low_m = map.number("elevation_image_min_z", 0.0);
    const double high_m = map.number("elevation_image_max_z", 5.0);
    std::vector<float> heights_m = greys_of(image);
    const auto [darkest, brightest] = std::ranges::minmax(heights_m);
    const double step_m = brightest > darkest ? (high_m - low_m) / (brightest - darkest) : 0.0;
    for (float& height_m : heights_m)
        height_m = static_cast<float>(low_m + step_m * (height_m - darkest));
    return terrain(map, {image.height, image.width, std::move(heights_m)});
}

PlacedMesh matrix_mesh(const MvsimNode& map, std::string_view matrix) {
    return terrain(map, heights_in(matrix));
}

}  // namespace scipd::sim
