// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Polygons with holes against the even-odd rule: a point is covered once where it lies within an
// odd number of outlines.
#include "sim/loaders/mesh/polygon_with_holes.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "sim/world/pose.h"

namespace scipd::sim {
namespace {

using Triangle = std::array<std::size_t, 3>;

/// Flat at first, in x and y.
struct Shape {
    std::vector<glm::dvec3> points;
    std::vector<Loop> loops;

    void add(const std::vector<glm::dvec2>& corners) {
        Loop loop;
        for (const auto& corner : corners) {
            loop.push_back(points.size());
            points.emplace_back(corner, 0.0);
        }
        loops.push_back(loop);
    }

    [[nodiscard]] bool covers(const glm::dvec2& p) const {
        bool inside = false;
        for (const Loop& loop : loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const glm::dvec2 a = points[loop[i]];
                const glm::dvec2 b = points[loop[(i + 1) % loop.size()]];
                if ((a.y > p.y) == (b.y > p.y)) continue;
                if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
            }
        }
        return inside;
    }
};

std::size_t count_at(const glm::dvec2& p, const std::vector<Triangle>& triangles,
                     const std::vector<glm::dvec3>& points) {
    std::size_t count = 0;
    for (const auto& triangle : triangles) {
        int left = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec2 a = points[triangle[i]];
            const glm::dvec2 b = points[triangle[(i + 1) % 3]];
            left += (b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x) ? 1 : 0;
        }
        count += left == 0 || left == 3 ? 1 : 0;
    }
    return count;
}

/// Also when it lies anywhere in space.
void expect_even_odd(const Shape& shape, std::mt19937& rng) {
    std::uniform_real_distribution<double> anywhere{-11.0, 11.0};
    std::vector<glm::dvec3> turned;
    const Pose pose = pose_from_rpy({100, -50, 3}, {anywhere(rng), anywhere(rng), anywhere(rng)});
    for (const auto& point : shape.points)
        turned.push_back(pose * point);
    for (const auto* points : {&shape.points, &std::as_const(turned)}) {
        const auto triangles =
            triangles_of(shape.loops[0], {shape.loops.begin() + 1, shape.loops.end()}, *points);
        for (int i = 0; i < 500; ++i) {
            const glm::dvec2 p{anywhere(rng), anywhere(rng)};
            ASSERT_EQ(count_at(p, triangles, shape.points), shape.covers(p) ? 1U : 0U)
                << p.x << ' ' << p.y;
        }
    }
}

std::vector<glm::dvec2> star(const glm::dvec2& middle, double least, double most, int corners,
                             std::mt19937& rng) {
    std::uniform_real_distribution<double> reach{least, most};
    std::vector<glm::dvec2> all;
    const bool turns_right = rng() % 2 == 0;
    for (int i = 0; i < corners; ++i) {
        const double angle_rad = (turns_right ? -i : i) * 2.0 * std::numbers::pi / corners;
        all.push_back(middle + reach(rng) * glm::dvec2{std::cos(angle_rad), std::sin(angle_rad)});
    }
    return all;
}

TEST(PolygonWithHoles, AWindowInAWall) {
    std::mt19937 rng{1};
    Shape shape;
    shape.add({{-10, -5}, {10, -5}, {10, 5}, {-10, 5}});
    shape.add({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}});
    expect_even_odd(shape, rng);
    EXPECT_EQ(triangles_of(shape.loops[0], {shape.loops[1]}, shape.points).size(), 8U);
}

TEST(PolygonWithHoles, WindowsInRowsWhoseCornersAlign) {
    std::mt19937 rng{2};
    Shape shape;
    shape.add({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 5; ++column) {
            const glm::dvec2 at{-9.0 + 4.0 * column, -9.0 + 5.0 * row};
            shape.add({at, at + glm::dvec2{0, 3}, at + glm::dvec2{2, 3}, at + glm::dvec2{2, 0}});
        }
    }
    expect_even_odd(shape, rng);
}

TEST(PolygonWithHoles, AHoleBehindAnArmOfTheOutline) {
    std::mt19937 rng{3};
    Shape shape;
    shape.add({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}, {-10, 8}, {8, 8}, {8, -8}, {-10, -8}});
    shape.add({{8.5, -1}, {9.5, -1}, {9.5, 1}, {8.5, 1}});
    expect_even_odd(shape, rng);
}

TEST(PolygonWithHoles, Stars) {
    std::mt19937 rng{4};
    for (int round = 0; round < 60; ++round) {
        Shape shape;
        shape.add(star({0, 0}, 7.5, 10.5, 8 + static_cast<int>(rng() % 20), rng));
        for (const double x : {-3.0, 0.5, 3.5}) {
            for (const double y : {-3.0, 0.0, 3.2})
                shape.add(star({x, y}, 0.2, 1.4, 3 + static_cast<int>(rng() % 8), rng));
        }
        ASSERT_NO_FATAL_FAILURE(expect_even_odd(shape, rng)) << round;
    }
}

TEST(PolygonWithHoles, WhatIsNoPolygonEnds) {
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}};
    EXPECT_TRUE(triangles_of({0, 1}, {}, points).empty());
    EXPECT_TRUE(triangles_of({0, 0, 0, 0}, {{1, 1, 1}}, points).empty());
    EXPECT_LE(triangles_of({0, 1, 2, 3}, {{4, 4, 4}}, points).size(), 8U);
    EXPECT_LE(triangles_of({0, 2, 1, 3}, {{0, 2, 1}, {4, 1, 0}}, points).size(), 20U);
}

}  // namespace
}  // namespace scipd::sim
