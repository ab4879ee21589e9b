// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A maze as in a rescue arena, for benchmarks: 20 x 20 cells of 1.2 m with walls and crates. It has
// 467 boxes, which are 5604 triangles.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/scene_builder.h"

namespace scipd::sim {

inline constexpr int maze_cells = 20;
inline constexpr double cell_m = 1.2;
inline constexpr double maze_m = maze_cells * cell_m;

/// The scene's first models are `movables` boxes of 0.4 m that can move.
inline SharedScene maze(std::size_t movables = 0) {
    constexpr double wall_height_m = 0.6;
    constexpr double thick_m = 0.04;
    std::mt19937 rng(20);
    const auto cell = [&] { return std::uniform_int_distribution<int>(1, maze_cells - 1)(rng); };
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(rng);
    };
    SceneBuilder scene;
    for (std::size_t i = 0; i < movables; ++i) {
        scene.movable(pose_from_rpy({cell() * cell_m, cell() * cell_m, 0.3}, {0, 0, 0}));
        scene.with(Box{{0.4, 0.4, 0.4}}, {}, 3);
    }
    const auto wall = [&](double x, double y, double size_x, double size_y) {
        scene.add(Box{{size_x, size_y, wall_height_m}},
                  pose_from_rpy({x, y, 0.5 * wall_height_m}, {0, 0, 0}), 1);
    };
    scene.add(Box{{maze_m, maze_m, 0.1}},
              pose_from_rpy({maze_m / 2, maze_m / 2, -0.05}, {0, 0, 0}));
    for (const double side_m : {0.0, maze_m}) {
        wall(side_m, maze_m / 2, thick_m, maze_m);
        wall(maze_m / 2, side_m, maze_m, thick_m);
    }
    for (int i = 0; i < 181; ++i) {
        wall(cell() * cell_m, (cell() + 0.5) * cell_m, thick_m, cell_m);
        wall((cell() + 0.5) * cell_m, cell() * cell_m, cell_m, thick_m);
    }
    for (int i = 0; i < 100; ++i) {  // at the corners of cells, so that the middles stay free
        const double size_m = uniform(0.15, 0.5);
        scene.add(Box{{size_m, size_m, uniform(0.2, 0.6)}},
                  pose_from_rpy({cell() * cell_m, cell() * cell_m, 0.2},
                                {0, 0, uniform(0, std::numbers::pi)}),
                  2);
    }
    return scene.build();
}

/// Poses in the middles of cells, at the height of a small robot, tilted by about half a degree.
inline std::vector<Pose> maze_poses(std::size_t count) {
    std::mt19937 rng(64);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(rng);
    };
    std::vector<Pose> poses;
    while (poses.size() < count) {
        const double x = (std::floor(uniform(0, maze_cells)) + uniform(0.35, 0.65)) * cell_m;
        const double y = (std::floor(uniform(0, maze_cells)) + uniform(0.35, 0.65)) * cell_m;
        poses.push_back(pose_from_rpy({x, y, 0.3}, {uniform(-0.01, 0.01), uniform(-0.01, 0.01),
                                                    uniform(0, 2.0 * std::numbers::pi)}));
    }
    return poses;
}

}  // namespace scipd::sim
