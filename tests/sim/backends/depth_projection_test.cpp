// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_projection.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

/// Looks leftward and up, off its own middle, 40 x 3 pixels.
Strip slanted_strip() {
    Strip strip;
    strip.forward = glm::normalize(glm::dvec3{1, 2, 0.5});
    strip.left = glm::normalize(glm::cross(glm::dvec3{0, 0, 1}, strip.forward));
    strip.up = glm::cross(strip.forward, strip.left);
    strip.first = {-0.9, 0.1};
    strip.pitch = {0.04, 0.03};
    strip.size_px = {40, 3};
    return strip;
}

/// Where OpenGL puts a point: pixels count from the lower left corner's, by their centres.
struct Drawn {
    glm::dvec2 pixel;
    double depth;
};

Drawn draw(const Strip& strip, const glm::dvec3& point_m) {
    const glm::dvec4 clip = clip_from_sensor(strip) * glm::dvec4{point_m, 1.0};
    const glm::dvec2 viewport = 0.5 * (glm::dvec2{clip} / clip.w + 1.0) * glm::dvec2{strip.size_px};
    return {viewport - 0.5, clip.z / clip.w};
}

TEST(DepthProjection, GoesThereAndBack) {
    const Strip strip = slanted_strip();
    std::mt19937 rng(3);
    std::uniform_real_distribution<double> sideways(-1.5, 1.5);
    std::uniform_real_distribution<double> decades(-2.5, 4.0);
    for (int i = 0; i < 1000; ++i) {
        const double z_m = std::pow(10.0, decades(rng));
        const glm::dvec3 point_m =
            z_m * (strip.forward + sideways(rng) * strip.left + sideways(rng) * strip.up);
        const double range_m = glm::length(point_m);
        const glm::dvec3 direction = point_m / range_m;
        const Drawn drawn = draw(strip, point_m);
        EXPECT_NEAR(drawn.pixel.x, pixel_of(strip, direction).x, 1e-9);
        EXPECT_NEAR(drawn.pixel.y, pixel_of(strip, direction).y, 1e-9);
        EXPECT_NEAR(z_of_depth_m(drawn.depth), z_m, 1e-12 * z_m);
        EXPECT_NEAR(z_of_depth_m(drawn.depth) / cos_alpha(strip, direction), range_m,
                    1e-12 * range_m);
    }
}

TEST(DepthProjection, PutsWholePixelsAtTheirTangents) {
    const Strip strip = slanted_strip();
    const glm::dvec3 at_7_2 =
        strip.forward + (-0.9 + 7 * 0.04) * strip.left + (0.1 + 2 * 0.03) * strip.up;
    EXPECT_NEAR(pixel_of(strip, glm::normalize(at_7_2)).x, 7.0, 1e-9);
    EXPECT_NEAR(pixel_of(strip, glm::normalize(at_7_2)).y, 2.0, 1e-9);
}

TEST(DepthProjection, IsOneAtTheNearPlaneAndZeroAtInfinity) {
    const Strip strip = slanted_strip();
    EXPECT_DOUBLE_EQ(draw(strip, near_m * strip.forward).depth, 1.0);
    EXPECT_LT(draw(strip, 1e12 * strip.forward).depth, 1e-14);
    EXPECT_GT(draw(strip, 0.999 * near_m * strip.forward).depth, 1.0);  // cut off
    EXPECT_LE(near_m, 0.005);  // no scanner calls anything nearer a range
}

// Equation (1) as published, for the depth that OpenGL has by default, with a far plane that is
// farther and farther away.
TEST(DepthProjection, IsTheLimitOfThePublishedEquation) {
    const double z_m = 7.5;
    const double f = 1e9;
    const double n = near_m;
    const double default_depth = f * (z_m - n) / (z_m * (f - n));
    EXPECT_NEAR(-f * n / (default_depth * (f - n) - f), z_m, 1e-6);
    EXPECT_NEAR(z_of_depth_m(1.0 - default_depth), z_m, 1e-6);
}

}  // namespace
}  // namespace scipd::sim
