// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Maps of shapes whose outlines are known in closed form, and rays of the reference backend.
#include "sim/export/floor_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/export/ros_map_files.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using ::testing::HasSubstr;

constexpr double box_yaw_rad = 0.5;
const glm::dvec2 box_m{2.0, 1.0};
const glm::dvec2 box_size_m{1.0, 0.6};
const glm::dvec2 pillar_m{-1.5, -1.0};
constexpr double pillar_radius_m = 0.4;
constexpr double room_m = 8.0;

Scene room() {
    Scene scene;
    scene.models.push_back({"world"});
    const auto add = [&](const Shape& shape, const Pose& pose) {
        scene.objects.push_back(
            {"world::l::" + std::to_string(scene.objects.size()), 0, pose, shape});
    };
    add(Plane{{100.0, 100.0}}, {});
    add(Box{{room_m, room_m, 2.0}}, {{0.0, 0.0, 1.0}});  // seen from inside
    add(Box{{box_size_m, 1.0}}, pose_from_rpy({box_m, 0.5}, {0.0, 0.0, box_yaw_rad}));
    add(Cylinder{pillar_radius_m, 1.0}, {{pillar_m, 0.5}});
    return scene;
}

/// How far a point is from the outline of a rectangle around the origin.
double from_rectangle_m(const glm::dvec2& point, const glm::dvec2& size_m) {
    const glm::dvec2 out = glm::abs(point) - size_m / 2.0;
    if (out.x <= 0.0 && out.y <= 0.0) return -std::max(out.x, out.y);
    return glm::length(glm::max(out, glm::dvec2{0.0}));
}

/// In the frame of the box.
glm::dvec2 in_box_m(const glm::dvec2& point) {
    const glm::dvec2 to_box = point - box_m;
    const double c = std::cos(box_yaw_rad);
    const double s = std::sin(box_yaw_rad);
    return {c * to_box.x + s * to_box.y, -s * to_box.x + c * to_box.y};
}

double from_outline_m(const glm::dvec2& point) {
    return std::min({from_rectangle_m(point, {room_m, room_m}),
                     from_rectangle_m(in_box_m(point), box_size_m),
                     std::abs(glm::length(point - pillar_m) - pillar_radius_m)});
}

/// A robot cannot be there: outside of the room, or in a thing.
bool is_solid(const glm::dvec2& point) {
    const glm::dvec2 in_box = glm::abs(in_box_m(point));
    return std::max(std::abs(point.x), std::abs(point.y)) > room_m / 2.0 ||
           (in_box.x < box_size_m.x / 2.0 && in_box.y < box_size_m.y / 2.0) ||
           glm::length(point - pillar_m) < pillar_radius_m;
}

glm::dvec2 middle_m(const FloorMap& map, std::size_t column, std::size_t row) {
    return map.origin_m + map.resolution_m * (glm::dvec2(column, row) + 0.5);
}

MapCell cell_at(const FloorMap& map, const glm::dvec2& point_m) {
    const glm::dvec2 cell = glm::floor((point_m - map.origin_m) / map.resolution_m);
    return map.at(static_cast<std::size_t>(cell.x), static_cast<std::size_t>(cell.y));
}

class FloorMaps : public ::testing::TestWithParam<double> {};

TEST_P(FloorMaps, AreFreeWhereTheMiddleOfACellCanBeReached) {
    const auto map = floor_map(placed_meshes(room()), {.resolution_m = GetParam()});
    ASSERT_TRUE(map) << map.error().why;
    std::size_t occupied = 0;
    std::size_t at_corners = 0;
    for (std::size_t row = 0; row < map->rows; ++row) {
        for (std::size_t column = 0; column < map->columns; ++column) {
            const glm::dvec2 at_m = middle_m(*map, column, row);
            const MapCell cell = map->at(column, row);
            occupied += cell == MapCell::occupied ? 1 : 0;
            const double off_m = from_outline_m(at_m);
            EXPECT_TRUE(cell != MapCell::occupied || off_m <= std::numbers::sqrt2 * GetParam());
            if (off_m <= 2.0 * export_tolerance_m) continue;
            EXPECT_FALSE(cell == MapCell::free && is_solid(at_m)) << at_m.x << ' ' << at_m.y;
            EXPECT_FALSE(cell == MapCell::unknown && !is_solid(at_m)) << at_m.x << ' ' << at_m.y;
            at_corners += cell == MapCell::occupied && !is_solid(at_m) ? 1 : 0;
        }
    }
    EXPECT_GT(occupied, 4 * room_m / GetParam());
    EXPECT_LE(at_corners, 8U);
    EXPECT_EQ(cell_at(*map, {0.0, 0.0}), MapCell::free);
    EXPECT_EQ(cell_at(*map, {-3.9 + GetParam(), 3.9 - GetParam()}), MapCell::free);
    EXPECT_EQ(cell_at(*map, box_m), MapCell::unknown);
    EXPECT_EQ(cell_at(*map, pillar_m), MapCell::unknown);
}

/// A room of this size around the origin, turned by yaw.
Scene room_of(const glm::dvec2& size_m, const glm::dvec2& middle_m, double yaw_rad) {
    Scene scene;
    scene.models.push_back({"world"});
    scene.objects.push_back({"world::l::room", 0,
                             pose_from_rpy({middle_m, 1.0}, {0.0, 0.0, yaw_rad}),
                             Box{{size_m, 2.0}}});
    return scene;
}

/// Length of the way from a place to the first occupied cell.
double way_m(const FloorMap& map, const glm::dvec2& from_m, const glm::dvec2& along) {
    for (double m = 0.0;; m += 0.01 * map.resolution_m) {
        if (cell_at(map, from_m + m * along) == MapCell::occupied) return m;
    }
}

// The walls of rooms of random sizes lie anywhere in a cell. Before each of them a scanner is as
// far from the map as from the wall, on the average.
TEST_P(FloorMaps, AreNotSystematicallyNearerThanTheWorld) {
    std::mt19937 random(53);
    std::uniform_real_distribution<double> size_m(3.0, 3.0 + 8.0 * GetParam());
    for (const double yaw_rad : {0.0, 0.5}) {
        double sum_cells = 0.0;
        int ways = 0;
        for (int i = 0; i < 60; ++i) {
            const glm::dvec2 room_m{size_m(random), size_m(random)};
            const auto map = floor_map(placed_meshes(room_of(room_m, {}, yaw_rad)),
                                       {.resolution_m = GetParam()});
            ASSERT_TRUE(map) << map.error().why;
            for (int wall = 0; wall < 4; ++wall) {
                const double to_rad = yaw_rad + wall * std::numbers::pi / 2.0;
                const glm::dvec2 along{std::cos(to_rad), std::sin(to_rad)};
                const double wall_m = (wall % 2 == 0 ? room_m.x : room_m.y) / 2.0;
                for (int k = -3; k <= 3; ++k) {
                    const glm::dvec2 from_m = 0.13 * k * glm::dvec2{-along.y, along.x};
                    const double off_cells = (way_m(*map, from_m, along) - wall_m) / GetParam();
                    EXPECT_LE(std::abs(off_cells), yaw_rad == 0.0 ? 0.52 : 1.0);
                    sum_cells += off_cells;
                    ++ways;
                }
            }
        }
        EXPECT_NEAR(sum_cells / ways, 0.0, 0.1) << yaw_rad;
    }
}

INSTANTIATE_TEST_SUITE_P(All, FloorMaps, ::testing::Values(0.02, 0.05, 0.1));

// Vertices in single precision are a little off; the cell behind is occupied all the same.
TEST(FloorMap, FillsTheCellBehindAFaceOnTheBorderOfACell) {
    for (const double off_m : {-1e-7, 0.0, 1e-7}) {
        const auto map = floor_map(placed_meshes(room_of({6.3, 4.3}, {off_m, -off_m}, 0.0)), {});
        ASSERT_TRUE(map);
        EXPECT_EQ(cell_at(*map, {3.14, 0.01}), MapCell::free);
        EXPECT_EQ(cell_at(*map, {3.16, 0.01}), MapCell::occupied);
        EXPECT_EQ(cell_at(*map, {-3.14, 0.01}), MapCell::free);
        EXPECT_EQ(cell_at(*map, {-3.16, 0.01}), MapCell::occupied);
        EXPECT_EQ(cell_at(*map, {0.01, 2.14}), MapCell::free);
        EXPECT_EQ(cell_at(*map, {0.01, 2.16}), MapCell::occupied);
        EXPECT_EQ(cell_at(*map, {0.01, -2.14}), MapCell::free);
        EXPECT_EQ(cell_at(*map, {0.01, -2.16}), MapCell::occupied);
    }
}

TEST(FloorMap, HasThinAndSmallThingsWhereverTheyLieInACell) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> in_cell_m(0.0, 0.05);
    for (int i = 0; i < 200; ++i) {
        Scene scene = room_of({6.0, 6.0}, {}, 0.0);
        const double panel_m = 1.0 + in_cell_m(random);
        const glm::dvec2 pole_m{-1.0 + in_cell_m(random), -1.0 + in_cell_m(random)};
        scene.objects.push_back({"world::l::panel", 0, {{panel_m, 0.0, 0.5}}, Box{{0.001, 1, 1}}});
        scene.objects.push_back({"world::l::pole", 0, {{pole_m, 0.5}}, Cylinder{0.006, 1.0}});
        const auto map = floor_map(placed_meshes(scene), {});
        ASSERT_TRUE(map);
        int panel_cells = 0;
        int pole_cells = 0;
        for (int x = -2; x <= 2; ++x) {
            const auto occupied = [&](const glm::dvec2& at_m) {
                return cell_at(*map, at_m) == MapCell::occupied ? 1 : 0;
            };
            panel_cells += occupied({panel_m + 0.05 * x, 0.012});
            for (int y = -2; y <= 2; ++y)
                pole_cells += occupied(pole_m + 0.05 * glm::dvec2{x, y});
        }
        EXPECT_GE(panel_cells, 1) << panel_m;
        EXPECT_LE(panel_cells, 2) << panel_m;
        EXPECT_GE(pole_cells, 1) << pole_m.x << ' ' << pole_m.y;
        EXPECT_LE(pole_cells, 4) << pole_m.x << ' ' << pole_m.y;
    }
}

TEST(FloorMap, LooksAtABandOfHeights) {
    Scene scene;
    scene.models.push_back({"m"});
    // A table: its top alone is in the band.
    scene.objects.push_back({"m::l::top", 0, {{1.0, 0.0, 0.75}}, Box{{1.0, 0.6, 0.04}}});
    scene.objects.push_back({"m::l::leg", 0, {{0.62, 0.0, 0.35}}, Box{{0.1, 0.1, 0.7}}});
    const auto meshes = placed_meshes(scene);
    const auto low = floor_map(meshes, {.resolution_m = 0.05});
    ASSERT_TRUE(low);
    EXPECT_EQ(cell_at(*low, {0.58, 0.02}), MapCell::occupied);
    EXPECT_EQ(low->origin_m.x, -0.05);  // the robot at 0 0 is in the map, with a cell around
    const auto high = floor_map(meshes, {.low_m = 0.1, .high_m = 1.0, .resolution_m = 0.05});
    ASSERT_TRUE(high);
    for (const double x_m : {0.52, 1.0, 1.48})
        EXPECT_EQ(cell_at(*high, {x_m, 0.02}), MapCell::occupied) << x_m;
    EXPECT_EQ(cell_at(*high, {0.3, 0.02}), MapCell::free);
}

TEST(FloorMap, SaysWhyThereIsNone) {
    const auto meshes = placed_meshes(room());
    const auto why = [&](const FloorMapOptions& options) {
        const auto map = floor_map(meshes, options);
        return map ? std::string{} : map.error().why;
    };
    EXPECT_EQ(why({.low_m = 3.0, .high_m = 3.0}),
              "nothing is at z = 3 m: the world reaches from z = 0 to 2 m");
    EXPECT_THAT(why({.resolution_m = 1e-5}), HasSubstr("1e8 are allowed: take larger ones"));
    EXPECT_THAT(floor_map({}, {}).error().why, HasSubstr("the world is empty"));
}

TEST(FloorMap, IsFreeAllOverWhereNoRobotTellsInsideFromOutside) {
    const auto map = floor_map(placed_meshes(room()), {.robots_m = {{4.0, 0.0}}});
    ASSERT_TRUE(map);
    EXPECT_FALSE(map->is_closed);
    EXPECT_EQ(cell_at(*map, box_m), MapCell::free);
    EXPECT_EQ(std::ranges::find(map->cells, MapCell::unknown), map->cells.end());
}

// What AMCL gets and what the scanner sees then agree.
TEST(FloorMap, ComesBackAsAWorld) {
    const tests::TempDir folder;
    const auto map = floor_map(placed_meshes(room()), {});
    ASSERT_TRUE(map);
    folder.write("hall's.pgm", pgm_of(*map));
    const auto yaml = folder.write("hall.yaml", yaml_of(*map, "hall's.pgm"));
    const auto loaded = load_scene(yaml);
    EXPECT_THAT(loaded.warnings, ::testing::IsEmpty());
    const auto seen_m = [&](const SharedScene& scene) {
        const auto backend = make_backend("reference", scene);
        const Pose pose{{0.3, -0.2, 0.17}};
        std::vector<float> ranges_m;
        for (int i = 0; i < 360; ++i) {
            const double angle_rad = std::numbers::pi * i / 180.0;
            const glm::vec3 along{std::cos(angle_rad), std::sin(angle_rad), 0.0};
            Hit hit;
            backend->cast({.directions = {&along, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
            ranges_m.push_back(hit.range_m);
        }
        return ranges_m;
    };
    const auto map_m = seen_m(loaded.scene);
    const auto room_m = seen_m(std::make_shared<const Scene>(room()));
    for (std::size_t i = 0; i < 360; ++i) {
        // At the edge of a thing a beam may meet a cell of it that it missed, as its neighbour did.
        const auto [least, most] =
            std::minmax({room_m[(i + 358) % 360], room_m[(i + 359) % 360], room_m[i],
                         room_m[(i + 1) % 360], room_m[(i + 2) % 360]});
        EXPECT_LE(map_m[i], most + 0.075F) << i;
        EXPECT_GE(map_m[i], least - 0.075F) << i;
    }
}

}  // namespace
}  // namespace scipd::sim
