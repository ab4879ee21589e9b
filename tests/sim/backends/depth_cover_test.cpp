// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_cover.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr double pi = std::numbers::pi;

using Directions = std::vector<glm::vec3>;

glm::vec3 level(double angle_rad) {
    return glm::vec3{std::cos(angle_rad), std::sin(angle_rad), 0.0};
}

Directions planar(std::size_t beams, double extent_rad) {
    Directions directions;
    for (std::size_t i = 0; i < beams; ++i)
        directions.push_back(level(extent_rad * (double(i) / double(beams - 1) - 0.5)));
    return directions;
}

/// The rays of a camera with square pixels, turned like this.
Directions pinhole(int side, double half_tangent, const glm::dvec3& forward) {
    const glm::dvec3 left = glm::normalize(glm::cross(glm::dvec3{0, 0, 1}, forward));
    const glm::dvec3 up = glm::cross(forward, left);
    Directions directions;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double a = half_tangent * (1.0 - (2.0 * x + 1.0) / side);
            const double b = half_tangent * (1.0 - (2.0 * y + 1.0) / side);
            directions.emplace_back(glm::normalize(forward + a * left + b * up));
        }
    }
    return directions;
}

Directions random_directions(std::size_t count) {
    std::mt19937 rng(5);
    std::normal_distribution<double> component;
    Directions directions;
    for (std::size_t i = 0; i < count; ++i) {
        directions.emplace_back(
            glm::normalize(glm::dvec3{component(rng), component(rng), component(rng)}));
    }
    return directions;
}

/// Every direction once, in a view that shows it.
void expect_covered(const Directions& directions, const std::vector<StripView>& views) {
    std::vector<int> times(directions.size());
    for (const StripView& view : views) {
        EXPECT_NEAR(glm::length(view.strip.forward), 1.0, 1e-9);
        EXPECT_NEAR(glm::dot(view.strip.forward, view.strip.left), 0.0, 1e-9);
        EXPECT_NEAR(glm::dot(view.strip.up - glm::cross(view.strip.forward, view.strip.left),
                             glm::dvec3{1.0}),
                    0.0, 1e-9);
        for (const Sample& sample : view.samples) {
            ++times[sample.ray];
            const glm::dvec3 direction{directions[sample.ray]};
            const glm::dvec2 pixel = pixel_of(view.strip, direction);
            EXPECT_GT(cos_alpha(view.strip, direction), 0.1);
            EXPECT_NEAR(sample.pixel.x, pixel.x, 2e-3);
            EXPECT_NEAR(sample.pixel.y, pixel.y, 2e-3);
            EXPECT_GE(sample.pixel.x, 0.0);
            EXPECT_GE(sample.pixel.y, 0.0);
            EXPECT_LE(sample.pixel.x, view.strip.size_px.x - 1);
            EXPECT_LE(sample.pixel.y, view.strip.size_px.y - 1);
        }
    }
    EXPECT_EQ(times, std::vector<int>(directions.size(), 1));
}

TEST(DepthCover, OfNothingIsNothing) {
    EXPECT_TRUE(cover({}, {}).empty());
}

TEST(DepthCover, GivesOneDirectionOnePixel) {
    for (const glm::vec3& direction : random_directions(50)) {
        const auto views = cover(std::vector{direction}, {});
        ASSERT_EQ(views.size(), 1U);
        EXPECT_EQ(views[0].strip.size_px, (glm::ivec2{1, 1}));
        EXPECT_NEAR(cos_alpha(views[0].strip, glm::dvec3{direction}), 1.0, 1e-6);
        expect_covered({direction}, views);
    }
}

TEST(DepthCover, CutsAPlanarScannerIntoStripsOfOneRow) {
    const Directions directions = planar(1081, 1.5 * pi);
    const auto views = cover(directions, {});
    ASSERT_EQ(views.size(), 3U);
    for (const StripView& view : views) {
        EXPECT_EQ(view.strip.size_px.y, 1);
        EXPECT_LE(std::abs(view.strip.first.x), std::tan(pi / 4) + 1e-6);
        EXPECT_NEAR(view.strip.up.z, 1.0, 1e-6);
    }
    expect_covered(directions, views);
}

TEST(DepthCover, TakesAPlaneThatIsTilted) {
    Directions directions;
    const glm::dvec3 left = glm::normalize(glm::dvec3{0.1, 1, 0.4});
    const glm::dvec3 forward = glm::normalize(glm::cross(left, glm::dvec3{0, 0.2, 1}));
    for (int i = 0; i < 200; ++i)
        directions.emplace_back(std::cos(0.01 * i) * forward + std::sin(0.01 * i) * left);
    const auto views = cover(directions, {});
    EXPECT_EQ(views.size(), 2U);  // 114 degrees
    for (const StripView& view : views)
        EXPECT_EQ(view.strip.size_px.y, 1);
    expect_covered(directions, views);
}

TEST(DepthCover, TakesAFullTurnAndDirectionsOppositeToEachOther) {
    const Directions turn = planar(361, 2.0 * pi);
    EXPECT_EQ(cover(turn, {}).size(), 4U);
    expect_covered(turn, cover(turn, {}));
    const Directions opposite{{1, 0, 0}, {-1, 0, 0}};
    expect_covered(opposite, cover(opposite, {}));
}

TEST(DepthCover, DrawsAtLeastThePixelsThatAreAskedFor) {
    const double beam_rad = 0.25 * pi / 180.0;
    for (const double oversample : {1.0, 2.0, 5.0}) {
        const auto views = cover(planar(361, 0.5 * pi), {.oversample = oversample});
        ASSERT_EQ(views.size(), 1U);
        // Pixels are widest, as angles, in the middle.
        EXPECT_LE(views[0].strip.pitch.x, beam_rad / oversample * 1.001);
    }
}

TEST(DepthCover, DrawsAsManyPassesAsAreAskedFor) {
    const Directions directions = planar(1081, 1.5 * pi);
    const auto views = cover(directions, {.widest_pass_rad = pi / 8});
    EXPECT_EQ(views.size(), 12U);
    expect_covered(directions, views);
    const Directions grid = pinhole(40, 1.0, {1, 0, 0});
    EXPECT_GE(cover(grid, {.widest_pass_rad = pi / 4}).size(), 4U);
    expect_covered(grid, cover(grid, {.widest_pass_rad = pi / 4}));
}

TEST(DepthCover, GivesACameraAPixelForEachOfItsOwn) {
    for (const glm::dvec3& forward :
         {glm::dvec3{1, 0, 0}, glm::normalize(glm::dvec3{-1, 2, 0.3})}) {
        const Directions directions = pinhole(50, 1.0, forward);
        const auto views = cover(directions, {});
        ASSERT_EQ(views.size(), 1U);
        EXPECT_EQ(views[0].strip.size_px, (glm::ivec2{50, 50}));
        for (const Sample& sample : views[0].samples) {
            EXPECT_NEAR(sample.pixel.x, std::round(sample.pixel.x), 1e-3);
            EXPECT_NEAR(sample.pixel.y, std::round(sample.pixel.y), 1e-3);
        }
        expect_covered(directions, views);
    }
}

TEST(DepthCover, GivesARowOfACameraAPixelForEachOfItsOwn) {
    Directions directions;
    for (int x = -500; x < 500; ++x)
        directions.emplace_back(glm::normalize(glm::dvec3{1.0, (x + 0.5) / 500.0, 0.0}));
    const auto views = cover(directions, {});
    ASSERT_EQ(views.size(), 1U);
    // Less apart than 1.5e-3: one more between two.
    EXPECT_EQ(views[0].strip.size_px, (glm::ivec2{1999, 1}));
}

TEST(DepthCover, CoversRingsWithPicturesAsFineAsTheRings) {
    Directions directions;
    for (int ring = -7; ring <= 8; ++ring) {
        const double elevation_rad = ring * 2.0 * pi / 180.0;
        for (int i = 0; i < 1800; ++i) {
            const double azimuth_rad = i * 2.0 * pi / 1800.0;
            directions.emplace_back(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                    std::cos(elevation_rad) * std::sin(azimuth_rad),
                                    std::sin(elevation_rad));
        }
    }
    const auto views = cover(directions, {});
    expect_covered(directions, views);
    EXPECT_GE(views.size(), 4U);
    EXPECT_LE(views.size(), 8U);
    for (const StripView& view : views)
        EXPECT_LE(view.strip.pitch.x, 2.0 * pi / 1800.0 * 1.01);
}

TEST(DepthCover, CoversConesAndSpheres) {
    Directions cone;
    for (const glm::vec3& direction : random_directions(20'000)) {
        if (direction.x > 0.95F) cone.push_back(direction);
    }
    ASSERT_GT(cone.size(), 100U);
    EXPECT_EQ(cover(cone, {}).size(), 1U);
    expect_covered(cone, cover(cone, {}));
    const Directions sphere = random_directions(3000);
    EXPECT_LE(cover(sphere, {}).size(), 24U);
    expect_covered(sphere, cover(sphere, {}));
}

// The edges of a box around the eye: some views see a line of them only.
TEST(DepthCover, CoversEdgesThatAreSeenAsLines) {
    Directions directions;
    for (int i = 0; i <= 100; ++i) {
        const auto along = static_cast<float>(-5.0 + 0.1 * i);
        directions.push_back(glm::normalize(glm::vec3{5, 5, along}));
        directions.push_back(glm::normalize(glm::vec3{along, 5, -5}));
    }
    expect_covered(directions, cover(directions, {}));
}

}  // namespace
}  // namespace scipd::sim
