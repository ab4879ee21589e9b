// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/world/material_library.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "sim/world/lit_world.h"
#include "sim/world/reflection.h"

namespace scipd::sim {
namespace {

constexpr double white = 0.9;

MaterialOptics wood() {
    return {.name = "wood",
            .aliases = {"oak", "Gazebo/Wood"},
            .reflectance = {{800, 0.4}, {900, 0.6}},
            .specular = 0.25,
            .gloss = 10.0,
            .roughness = 0.2,
            .texture = 0.1,
            .source = "a tree",
            .numbers = 6,
            .assumed = 2};
}

MaterialOptics glass() {
    return {.name = "glass",
            .aliases = {},
            .reflectance = {{905, 0.04}},
            .specular = 1.0,
            .gloss = 2000.0,
            .transmission = 0.9,
            .source = "sand",
            .numbers = 4};
}

MaterialLibrary library() {
    MaterialLibrary library;
    library.add({.name = "default", .aliases = {"wall"}, .reflectance = {{905, white}}});
    library.add(wood());
    library.add(glass());
    return library;
}

double energy_of(const Surface& surface) {
    return surface.diffuse + surface.specular + surface.retro + surface.transmission;
}

/// How bright a face is at right angles, to the scanner itself, where a white Lambertian face is 1.
/// Written anew here: what goes into a cone of this half angle, against what goes to all sides.
double brightness_of(const Surface& surface) {
    const double half_rad = std::numbers::pi / 180.0;
    const double cone_sr = 4.0 * std::numbers::pi * std::pow(std::sin(half_rad / 2.0), 2.0);
    return surface.diffuse + surface.retro * std::numbers::pi / cone_sr;
}

TEST(MaterialLibrary, FindsNamesAndAliasesInWhateverCase) {
    const auto known = library();
    for (const char* name : {"wood", "Wood", "oak", "OAK", "Gazebo/Wood", "gazebo/wood"}) {
        ASSERT_NE(known.find(name), nullptr) << name;
        EXPECT_EQ(known.find(name)->name, "wood");
    }
    EXPECT_EQ(known.find("woo"), nullptr);
    EXPECT_EQ(known.find(""), nullptr);
}

TEST(MaterialLibrary, InterpolatesBetweenWavelengthsAndKeepsTheOutermost) {
    const auto known = library();
    const auto reflectance = [&](int wavelength_nm) {
        const Surface surface = known.surface({"wood"}, wavelength_nm);
        return surface.diffuse + surface.specular;
    };
    EXPECT_FLOAT_EQ(reflectance(785), 0.4F);
    EXPECT_FLOAT_EQ(reflectance(800), 0.4F);
    EXPECT_FLOAT_EQ(reflectance(825), 0.45F);
    EXPECT_FLOAT_EQ(reflectance(900), 0.6F);
    EXPECT_FLOAT_EQ(reflectance(905), 0.6F);
}

TEST(MaterialLibrary, SplitsTheReflectanceAndKeepsTheRest) {
    const Surface surface = library().surface({"oak"}, 800);
    EXPECT_EQ(surface, (Surface{.diffuse = 0.3F,
                                .specular = 0.1F,
                                .gloss = 10.0F,
                                .retro = 0.0F,
                                .transmission = 0.0F,
                                .roughness = 0.2F,
                                .texture = 0.1F}));
}

TEST(MaterialLibrary, TakesWhatNobodyKnowsAsItsDefault) {
    EXPECT_FLOAT_EQ(library().surface({"cheese"}, 905).diffuse, 0.9F);
    EXPECT_EQ(MaterialLibrary{}.surface({"cheese"}, 905), Surface{});
    MaterialLibrary grey = library();
    grey.add({.name = "default", .reflectance = {{905, 0.5}}});
    EXPECT_FLOAT_EQ(grey.surface({"cheese"}, 905).diffuse, 0.5F);
    EXPECT_FLOAT_EQ(grey.surface({"wall"}, 905).diffuse, 0.5F);
}

TEST(MaterialLibrary, LetsTheLastWordCountEntryByEntry) {
    MaterialLibrary known = library();
    known.add({.name = "Wood", .reflectance = {{905, 0.1}}, .numbers = 1});
    EXPECT_EQ(known.materials().size(), 3U);
    EXPECT_FLOAT_EQ(known.surface({"oak"}, 905).diffuse, 0.1F);
    known.add({.name = "oak", .reflectance = {{905, 0.2}}, .numbers = 1, .assumed = 1});
    EXPECT_FLOAT_EQ(known.surface({"oak"}, 905).diffuse, 0.2F);
    EXPECT_FLOAT_EQ(known.surface({"wood"}, 905).diffuse, 0.1F);
    EXPECT_EQ(known.numbers(), 1U + 4U + 1U);
    EXPECT_EQ(known.assumed(), 1U);
}

TEST(MaterialLibrary, UsesTheAppearanceOfWhatItDoesNotKnowAlone) {
    const auto known = library();
    const Appearance clear{.transparency = 0.75};
    EXPECT_EQ(known.surface({"wood", {}, clear}, 905), known.surface({"wood"}, 905));
    for (const char* name : {"cheese", "default", "wall"}) {
        const Surface surface = known.surface({name, {}, clear}, 905);
        EXPECT_FLOAT_EQ(surface.transmission, 0.75F * 0.96F) << name;
        EXPECT_FLOAT_EQ(surface.diffuse, 0.25F * 0.9F);
        EXPECT_FLOAT_EQ(surface.specular, 0.75F * 0.04F);
        EXPECT_GT(surface.gloss, 1000.0F);
        EXPECT_LE(energy_of(surface), 1.0 + 1e-6);
    }
}

TEST(MaterialLibrary, MakesMetalMirrorItsReflectance) {
    const auto metal = [](double metalness, std::optional<double> roughness) {
        return library().surface({"cheese", {}, {{}, metalness, roughness}}, 905);
    };
    EXPECT_FLOAT_EQ(metal(1.0, 0.3).specular, 0.9F);
    EXPECT_FLOAT_EQ(metal(1.0, 0.3).diffuse, 0.0F);
    EXPECT_FLOAT_EQ(metal(0.4, 0.3).diffuse, 0.9F * 0.6F);
    // The smoother, the narrower, from a mirror to a matt face.
    EXPECT_FLOAT_EQ(metal(1.0, 0.0).gloss, 1e5F);
    EXPECT_GT(metal(1.0, 0.3).gloss, metal(1.0, {}).gloss);
    EXPECT_EQ(metal(1.0, {}), metal(1.0, 0.5));
    EXPECT_FLOAT_EQ(metal(1.0, 1.0).gloss, 1.0F);
    EXPECT_LE(energy_of(metal(0.7, 0.1)), 1.0 + 1e-6);
}

TEST(MaterialLibrary, TakesLaserRetroUpToOneAsTheReflectance) {
    const auto known = library();
    EXPECT_FLOAT_EQ(known.surface({"cheese", 0.3}, 905).diffuse, 0.3F);
    // For a known material it is how bright the face is; the rest stays.
    const Surface dark_wood = known.surface({"wood", 0.2}, 905);
    EXPECT_FLOAT_EQ(dark_wood.diffuse, 0.15F);
    EXPECT_FLOAT_EQ(dark_wood.specular, 0.05F);
    EXPECT_FLOAT_EQ(dark_wood.gloss, 10.0F);
    // More than is left is not there.
    EXPECT_LE(energy_of(known.surface({"glass", 1.0}, 905)), 1.0 + 1e-6);
}

TEST(MaterialLibrary, TakesAGreaterLaserRetroAsSoManyTimesAsBrightAsWhite) {
    const auto known = library();
    for (const double times : {2.0, 100.0, 1000.0}) {
        const double brightness = brightness_of(known.surface({"default", times}, 905));
        EXPECT_NEAR(brightness, times, 0.2 + 0.001 * times);
    }
    for (const double times : {1.5, 300.0, 3000.0, 5000.0, 1e300}) {
        for (const char* name : {"default", "wood", "glass", "cheese"}) {
            const Surface surface = known.surface({name, times}, 905);
            EXPECT_LE(energy_of(surface), 1.0 + 1e-6) << name << ' ' << times;
            EXPECT_GE(surface.diffuse, 0.0F);
            EXPECT_GE(surface.transmission, 0.0F);
        }
    }
    EXPECT_FLOAT_EQ(known.surface({"wood", 5000.0}, 905).retro, 1.0F);
}

TEST(MaterialLibrary, HearsNothingInALaserRetroOfZero) {
    const auto known = library();
    for (const double nothing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(known.surface({"wood", nothing}, 905), known.surface({"wood"}, 905));
}

TEST(Appearance, KeepsWhatSaysSomething) {
    EXPECT_EQ(as_said({}, {}, {}), Appearance{});
    EXPECT_EQ(as_said(0.0, 0.0, 0.4), Appearance{});
    EXPECT_EQ(as_said(std::numeric_limits<double>::quiet_NaN(), {}, {}), Appearance{});
    EXPECT_EQ(as_said(7.0, 0.5, -1.0), (Appearance{1.0, 0.5, 0.0}));
}

// A greater laser_retro is never darker, whatever the library says of the name.
TEST(LaserRetro, IsNeverDarkerWhereItIsGreater) {
    MaterialLibrary library;
    library.add({.name = "rubber", .reflectance = {{905, 0.02}}});
    library.add({.name = "pane",
                 .reflectance = {{905, 0.04}},
                 .specular = 1.0,
                 .gloss = 2000,
                 .transmission = 0.95});
    for (const char* name : {"rubber", "pane", "unheard of"}) {
        double before = 0.0;
        for (const double retro : {0.1, 0.5, 1.0, 1.0001, 1.5, 2.0, 50.0, 4000.0}) {
            const Surface surface = library.surface({name, retro}, 905);
            const float all =
                surface.diffuse + surface.specular + surface.retro + surface.transmission;
            EXPECT_LE(all, 1.0F + 1e-5F) << name << " " << retro;
            const double head_on = returned_share(surface, 1.0);
            EXPECT_GE(head_on, before * (1.0 - 1e-3)) << name << " " << retro;
            before = head_on;
        }
    }
    EXPECT_NEAR(returned_share(library.surface({"rubber", 2.0}, 905), 1.0), 2.0, 0.01);
}

// A scene keeps the materials of models that have left it.
TEST(LightGoesOn, OnlyWhereSomethingIsMadeOfGlass) {
    MaterialLibrary library;
    library.add({.name = "glass", .reflectance = {{905, 0.04}}, .transmission = 0.95});
    Scene scene;
    scene.materials.push_back({"glass"});
    EXPECT_FALSE(light_goes_on(scene, library, 905));
    scene.models.push_back({"pane"});
    scene.objects.push_back({.name = "pane", .shape = Box{{1, 1, 1}}, .material = 1});
    EXPECT_TRUE(light_goes_on(scene, library, 905));
}

}  // namespace
}  // namespace scipd::sim
