// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/map/map_walls.h"

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sim/loaders/map/map_folder.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

/// '#' is occupied; rows from the bottom.
CellGrid grid_of(const std::vector<std::string>& rows) {
    CellGrid grid{rows.front().size(), rows.size(), {}};
    for (const auto& row : rows) {
        for (const char cell : row)
            grid.cells.push_back(cell == '#' ? Cell::occupied : Cell::free);
    }
    return grid;
}

CellGrid noise(std::mt19937& rng, std::size_t columns, std::size_t rows, double share) {
    std::bernoulli_distribution occupied{share};
    CellGrid grid{columns, rows, {}};
    for (std::size_t i = 0; i < columns * rows; ++i)
        grid.cells.push_back(occupied(rng) ? Cell::occupied : Cell::free);
    return grid;
}

Mesh solid_of(const CellGrid& grid) {
    return wall_mesh(grid, Cell::occupied, {.cell_m = 1.0, .bottom_m = 0.0, .top_m = 2.0});
}

/// A place, since vertices that lie together need not be one vertex.
using Place = std::tuple<float, float, float>;

/// How many triangles each edge bounds.
std::map<std::pair<Place, Place>, int> edges_of(const Mesh& mesh) {
    std::map<std::pair<Place, Place>, int> edges;
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const auto place = [&](int corner) {
                const glm::vec3& at = mesh.vertices_m[triangle[corner % 3]];
                return Place{at.x, at.y, at.z};
            };
            const auto [low, high] = std::minmax({place(i), place(i + 1)});
            ++edges[{low, high}];
        }
    }
    return edges;
}

double area_at_height(const Mesh& mesh, float z_m) {
    double area_m2 = 0.0;
    for (const auto& triangle : mesh.triangles) {
        const auto& a = mesh.vertices_m[triangle[0]];
        const auto& b = mesh.vertices_m[triangle[1]];
        const auto& c = mesh.vertices_m[triangle[2]];
        if (a.z != z_m || b.z != z_m || c.z != z_m) continue;
        area_m2 += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    return area_m2;
}

double area_of(const CellGrid& grid) {
    return static_cast<double>(std::ranges::count(grid.cells, Cell::occupied));
}

TEST(MapWalls, aStraightWallIsABoxHoweverLong) {
    EXPECT_EQ(solid_of(grid_of({std::string(1000, '#')})).triangles.size(), 12U);
    EXPECT_EQ(solid_of(grid_of(std::vector<std::string>(1000, "#"))).triangles.size(), 12U);
    EXPECT_EQ(
        solid_of(grid_of(std::vector<std::string>(100, std::string(100, '#')))).triangles.size(),
        12U);
}

TEST(MapWalls, aRoomIsFourWalls) {
    std::vector<std::string> rows(50, "#" + std::string(48, '.') + "#");
    rows.front() = rows.back() = std::string(50, '#');
    const Mesh mesh = solid_of(grid_of(rows));
    // Outside and inside: 8 walls, of which the outer left and right are cut where the rows end; a
    // cap of 8 corners, outer and inner, and the 4 that cut: 12 triangles each.
    EXPECT_EQ(mesh.triangles.size(), 2U * (8 + 4) + 2U * 12);
    EXPECT_EQ(area_at_height(mesh, 2.F), 4 * 49);
}

TEST(MapWalls, nothingIsNothing) {
    EXPECT_TRUE(solid_of(grid_of({"...", "..."})).triangles.empty());
}

TEST(MapWalls, areRefusedWhereTheyAreNothingButNoise) {
    // The worst that there is: a tower of twelve triangles on every other cell.
    std::vector<std::string> rows;
    for (int row = 0; row < 10; ++row)
        rows.push_back(row % 2 == 0 ? "#.#.#.#.#." : ".#.#.#.#.#");
    const CellGrid board = grid_of(rows);
    EXPECT_EQ(solid_of(board).triangles.size(), 50U * 12U);
    EXPECT_NO_THROW(wall_mesh(board, Cell::occupied, {1.0, 0.0, 2.0, 600}));
    EXPECT_THROW(wall_mesh(board, Cell::occupied, {1.0, 0.0, 2.0, 599}), std::invalid_argument);
}

TEST(MapWalls, isClosedWithoutACrackOnAnyGrid) {
    std::mt19937 rng{4};
    for (int round = 0; round < 60; ++round) {
        const auto grid = noise(rng, 3 + round % 11, 2 + round % 7, 0.1 + 0.013 * round);
        const Mesh mesh = solid_of(grid);
        // Two triangles an edge; four along an upright edge where cells touch corner to corner.
        for (const auto& [edge, count] : edges_of(mesh)) {
            const bool upright = std::get<2>(edge.first) != std::get<2>(edge.second);
            ASSERT_TRUE(count == 2 || (upright && count == 4)) << "round " << round;
            ASSERT_NE(edge.first, edge.second);
        }
        ASSERT_EQ(area_at_height(mesh, 2.F), area_of(grid));
        ASSERT_EQ(area_at_height(mesh, 0.F), area_of(grid));
    }
}

TEST(MapWalls, standsWhereTheCellsAre) {
    std::mt19937 rng{5};
    for (int round = 0; round < 20; ++round) {
        const std::size_t columns = 9;
        const std::size_t rows = 6;
        const auto grid = noise(rng, columns, rows, 0.15 + 0.03 * round);
        Probe probe{
            SceneBuilder{}.add(std::make_shared<const Mesh>(solid_of(grid)), Pose{}).build()};
        for (std::size_t row = 0; row < rows; ++row) {
            const double y_m = static_cast<double>(row) + 0.4 - 0.5 * rows;
            // Along the row from outside: the first occupied cell ends the ray.
            double free_m = 1.0;
            for (std::size_t i = 0; i < columns && grid.at(i, row) == Cell::free; ++i)
                free_m += 1.0;
            const Hit hit = probe.cast({-0.5 * columns - 1.0, y_m, 1.0}, {1, 0, 0});
            EXPECT_EQ(hit.met(), free_m < 1.0 + columns);
            if (hit.met()) {
                EXPECT_NEAR(hit.range_m, free_m, 1e-6);
            }
            for (std::size_t column = 0; column < columns; ++column) {
                const double x_m = static_cast<double>(column) + 0.3 - 0.5 * columns;
                EXPECT_EQ(probe.top_m(x_m, y_m) == 2.F, grid.at(column, row) == Cell::occupied);
            }
        }
    }
}

TEST(MapWalls, cornersOfCellsLeakNoRay) {
    std::mt19937 rng{6};
    const auto grid = noise(rng, 30, 30, 0.5);
    // Turned, so that nothing is exact in float any more; the worst place to aim at is a corner.
    const Pose turn = pose_from_rpy({3.1, -2.7, 0.3}, {0.1, -0.2, 0.7});
    auto backend = make_backend(
        "embree", SceneBuilder{}.add(std::make_shared<const Mesh>(solid_of(grid)), turn).build());
    const auto is_inside = [&](std::size_t column, std::size_t row) {
        return grid.at(column - 1, row - 1) == Cell::occupied &&
               grid.at(column, row - 1) == Cell::occupied &&
               grid.at(column - 1, row) == Cell::occupied && grid.at(column, row) == Cell::occupied;
    };
    int aimed = 0;
    for (std::size_t row = 1; row < 30; ++row) {
        for (std::size_t column = 1; column < 30; ++column) {
            if (!is_inside(column, row)) continue;
            ++aimed;
            const glm::dvec3 corner_m{static_cast<double>(column) - 15.0,
                                      static_cast<double>(row) - 15.0, 5.0};
            const Pose above{turn * corner_m, turn.rotation};
            const glm::vec3 down{0.F, 0.F, -1.F};
            Hit hit;
            backend->cast({.directions = {&down, 1}, .world_from_sensor = {&above, 1}}, {&hit, 1});
            EXPECT_NEAR(hit.range_m, 3.F, 1e-4F) << column << ' ' << row;
        }
    }
    EXPECT_GT(aimed, 30);
}

}  // namespace
}  // namespace scipd::sim
