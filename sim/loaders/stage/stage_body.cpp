// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/stage/stage_body.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

#include "sim/loaders/map/map_picture.h"
#include "sim/loaders/map/map_walls.h"
#include "sim/loaders/map/occupancy.h"
#include "sim/world/bounds.h"
#include "sim/world/extrusion.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

/// Scales the meshes, as Stage does, so that all of them together span the size. In x and y their
/// middle moves to the origin; z is only scaled.
void fit(std::vector<Mesh>& meshes, const glm::dvec3& size_m) {
    Bounds bounds;
    for (const Mesh& mesh : meshes) {
        for (const glm::vec3& vertex : mesh.vertices_m)
            bounds.include(vertex);
    }
    const glm::dvec3 span = bounds.high_m - bounds.low_m;
    if (!(span.x > 1e-9 && span.y > 1e-9 && span.z > 1e-9)) {
        throw std::invalid_argument("has a body without volume");
    }
    glm::dvec3 middle = bounds.middle_m();
    middle.z = 0.0;
    for (Mesh& mesh : meshes) {
        for (glm::vec3& vertex : mesh.vertices_m)
            vertex = (glm::dvec3{vertex} - middle) * size_m / span;
    }
    const double highest_m =
        std::max(std::abs(bounds.low_m.z), std::abs(bounds.high_m.z)) * size_m.z;
    if (!(highest_m / span.z <= position_limit_m)) {
        throw std::invalid_argument("has a body higher than 1e7 m");
    }
}

/// Before the block is scaled to the size of the entity.
Mesh prism(const StageEntity& block, const StageUnits& units) {
    constexpr double most_points = 1'000;
    const double count = block.number("points", 0.0);
    if (!(count >= 3 && count <= most_points)) {
        throw std::invalid_argument("a block has from 3 to 1000 points");
    }
    Outline outline;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::string name = "point[" + std::to_string(i) + "]";
        const auto xy = block.numbers(name);
        if (xy.size() < 2) throw std::invalid_argument(name + " must be [x y]");
        outline.emplace_back(xy[0] * units.metres, xy[1] * units.metres);
        if (!plausible_position({outline.back(), 0.0}))
            throw std::invalid_argument(name + " must lie within 1e7 m");
    }
    auto z = block.numbers("z");
    if (z.size() < 2) z = {0.0, 1.0};
    if (!(z[0] < z[1] && plausible_position({z[0], z[1], 0.0})))
        throw std::invalid_argument("z must be [bottom top]");
    Mesh mesh = extrusion_mesh({outline}, (z[1] - z[0]) * units.metres);
    for (glm::vec3& vertex : mesh.vertices_m)
        vertex.z += static_cast<float>(z[0] * units.metres);
    return mesh;
}

/// Dark is what Stage takes for an obstacle: a first channel of up to 127 of 255.
CellGrid dark_cells(const MapImage& image) {
    CellGrid grid{image.width, image.height, {}};
    grid.cells.reserve(grid.columns * grid.rows);
    const unsigned brightest = 127U * image.white / 255U;
    std::visit(
        [&](const auto& samples) {
            for (std::size_t row = grid.rows; row-- > 0;) {
                for (std::size_t column = 0; column < grid.columns; ++column) {
                    const auto first = samples[(row * grid.columns + column) * image.channels];
                    grid.cells.push_back(first > brightest ? Cell::free : Cell::occupied);
                }
            }
        },
        image.samples);
    return grid;
}

}  // namespace

glm::dvec3 stage_size_m(const StageEntity& entity, const StageUnits& units) {
    glm::dvec3 size_m{0.4, 0.4, 1.0};
    const auto said = entity.numbers("size");
    for (std::size_t i = 0; i < std::min<std::size_t>(said.size(), 3); ++i)
        size_m[static_cast<int>(i)] = said[i] * units.metres;
    const bool fits = std::min({size_m.x, size_m.y, size_m.z}) > 0.0 && plausible_position(size_m);
    if (!fits) throw std::invalid_argument("every size must be above 0 and up to 1e7 m");
    return size_m;
}

std::vector<Mesh> block_meshes(const StageEntity& entity, const glm::dvec3& size_m,
                               const StageUnits& units) {
    std::vector<Mesh> meshes;
    for (const StageEntity& child : entity.children) {
        if (child.type == "block") meshes.push_back(prism(child, units));
    }
    if (!meshes.empty()) fit(meshes, size_m);
    return meshes;
}

Mesh bitmap_mesh(std::string_view picture, const glm::dvec3& size_m, std::size_t most_triangles) {
    const CellGrid grid = dark_cells(read_map_image(picture));
    const WallSize unit{
        .cell_m = 1.0, .bottom_m = 0.0, .top_m = 1.0, .most_triangles = most_triangles};
    std::vector<Mesh> meshes{wall_mesh(grid, Cell::occupied, unit)};
    if (meshes.front().triangles.empty()) return {};
    fit(meshes, size_m);
    return std::move(meshes.front());
}

}  // namespace scipd::sim
