// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What faces send back, against closed forms and against integrals over the half space.
#include "sim/world/reflection.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

constexpr double pi = std::numbers::pi;

const std::vector<Surface> many_surfaces = {
    {},
    {.diffuse = 0.02F},
    {.diffuse = 0.5F, .specular = 0.1F, .gloss = 20.0F},
    {.diffuse = 0.1F, .specular = 0.8F, .gloss = 1000.0F},
    {.diffuse = 0.4F, .roughness = 0.5F},
    {.diffuse = 0.3F, .retro = 0.2F},
};

TEST(Reflection, IsLamberts) {
    const Reflection matt({.diffuse = 0.7F});
    for (const double cosine : {1.0, 0.9, 0.5, 0.1, 0.0})
        EXPECT_NEAR(matt.returned(static_cast<float>(cosine)), 0.7 * cosine, 1e-4) << cosine;
}

TEST(Reflection, TabulatesItsClosedForm) {
    for (const Surface& surface : many_surfaces) {
        const Reflection material(surface);
        for (int i = 0; i <= 2000; ++i) {
            const double angle_rad = 0.5 * pi * i / 2000;
            const double truth = returned_share(surface, std::cos(angle_rad));
            const auto cosine = static_cast<float>(std::cos(angle_rad));
            ASSERT_NEAR(material.returned(cosine) + material.highlight(cosine, 0.0), truth,
                        2e-3 * returned_share(surface, 1.0))
                << angle_rad << " rad, gloss " << surface.gloss;
        }
    }
}

TEST(Reflection, GrowsWithTheReflectance) {
    for (const double cosine : {1.0, 0.7, 0.2}) {
        double before = 0.0;
        for (const float diffuse : {0.02F, 0.1F, 0.5F, 0.9F}) {
            const double now = returned_share({.diffuse = diffuse, .roughness = 0.3F}, cosine);
            EXPECT_GT(now, before);
            before = now;
        }
    }
}

/// What a lobe around the normal sends into the half space, where it sends `peak` times as much
/// light along the normal as a white Lambertian face.
template <class Lobe>
double all_light(double peak, Lobe lobe) {
    constexpr int steps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double angle_rad = 0.5 * pi * (i + 0.5) / steps;
        sum += lobe(angle_rad) * std::cos(angle_rad) * 2.0 * pi * std::sin(angle_rad);
    }
    return peak / pi * sum * 0.5 * pi / steps;
}

TEST(Reflection, CreatesNoLight) {
    for (const double gloss : {1.0, 20.0, 500.0, 1e5}) {
        const Surface mirror{.diffuse = 0.0F, .specular = 1.0F, .gloss = static_cast<float>(gloss)};
        const double light = all_light(returned_share(mirror, 1.0), [&](double angle_rad) {
            return std::pow(std::cos(angle_rad), gloss);
        });
        EXPECT_NEAR(light, 1.0, 1e-3) << gloss;
    }
    const Surface reflector{.diffuse = 0.0F, .retro = 1.0F};
    const double light = all_light(returned_share(reflector, 1.0), [](double angle_rad) {
        return angle_rad < retro_cone_rad ? 1.0 : 0.0;
    });
    EXPECT_NEAR(light, 1.0, 1e-2);
    // Oren and Nayar's face, which is brightest where the light comes from.
    const Surface rough{.diffuse = 1.0F, .roughness = 0.6F};
    EXPECT_LE(returned_share(rough, 1.0), 1.0);
    for (const double cosine : {0.9, 0.6, 0.3})
        EXPECT_LE(returned_share(rough, cosine), 1.0) << cosine;
}

// A mirror shows itself to a scanner only head-on: 2 t away from it the light has gone.
TEST(Reflection, SendsTheLobeAwayFromTheScanner) {
    const Surface glossy{.diffuse = 0.0F, .specular = 0.9F, .gloss = 100.0F};
    EXPECT_NEAR(returned_share(glossy, 1.0), 0.9 * 51.0, 1e-4);
    const double cos_10_deg = std::cos(pi / 18);
    EXPECT_NEAR(returned_share(glossy, cos_10_deg),
                0.9 * 51.0 * std::pow(std::cos(pi / 9), 100.0) * cos_10_deg, 1e-4);
    EXPECT_EQ(returned_share(glossy, std::cos(pi / 3)), 0.0);
}

// Light that spreads by 10 mrad makes of a perfect mirror's lobe that of a gloss of 10000.
TEST(Reflection, BlursHighlights) {
    const Reflection mirror({.diffuse = 0.0F, .specular = 0.5F, .gloss = 1e8F});
    const Surface blurred{.diffuse = 0.0F, .specular = 0.5F, .gloss = 1e4F};
    for (const double angle_rad : {0.0, 0.005, 0.02}) {
        const double truth = returned_share(blurred, std::cos(angle_rad));
        EXPECT_NEAR(mirror.highlight(static_cast<float>(std::cos(angle_rad)), 1e-4), truth,
                    1e-2 * truth + 1e-3)
            << angle_rad;
    }
    EXPECT_EQ(Reflection({.specular = 0.5F, .gloss = 50.0F}).highlight(1.0F, 1e-4), 0.0F);
}

TEST(Reflection, MirrorsOnlyWhereItIsSmooth) {
    EXPECT_EQ(Reflection({.specular = 0.5F, .gloss = 50.0F}).mirrored(), 0.0F);
    EXPECT_EQ(Reflection({.specular = 0.5F, .gloss = 2000.0F}).mirrored(), 0.5F);
}

}  // namespace
}  // namespace scipd::sim
