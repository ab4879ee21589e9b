// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scenes/materials.yaml, the library that comes with scipd, and the worlds that come with it.
#include <filesystem>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::filesystem::path scenes{SCIPD_SCENES};

MaterialLibrary stock() {
    MaterialLibrary library;
    for (MaterialOptics& material : load_materials(scenes / "materials.yaml"))
        library.add(std::move(material));
    return library;
}

TEST(StockMaterials, HaveAllThatUsersAskFor) {
    const MaterialLibrary library = stock();
    EXPECT_GE(library.materials().size(), 30U);
    for (const char* name :
         {"white_paper",    "matt_black",     "black_foam",      "wood",         "concrete",
          "brick",          "plaster",        "asphalt",         "grass",        "soil",
          "skin",           "clothing_light", "clothing_dark",   "rubber",       "brushed_metal",
          "polished_metal", "car_paint_dark", "car_paint_light", "glass",        "tinted_glass",
          "acrylic",        "mirror",         "reflective_tape", "traffic_sign", "water",
          "snow",           "cardboard",      "carpet",          "pvc",          "leaves",
          "smoke",          "default"}) {
        const MaterialOptics* const known = library.find(name);
        ASSERT_NE(known, nullptr) << name;
        EXPECT_EQ(known->name, name);
    }
}

TEST(StockMaterials, SayWhereTheirNumbersComeFrom) {
    const MaterialLibrary library = stock();
    for (const MaterialOptics& material : library.materials()) {
        EXPECT_GE(material.numbers, material.reflectance.size()) << material.name;
        EXPECT_LE(material.assumed, material.numbers) << material.name;
        EXPECT_TRUE(!material.source.empty() || material.assumed == material.numbers)
            << material.name;
        // What nobody could look up is nobody's figure.
        if (material.source.find("from memory") != std::string::npos) {
            EXPECT_EQ(material.assumed, material.numbers) << material.name;
        }
    }
}

TEST(StockMaterials, GiveBackNoMoreThanFallsOnThemAtAnyWavelength) {
    const MaterialLibrary library = stock();
    for (const MaterialOptics& material : library.materials()) {
        for (int wavelength_nm = 700; wavelength_nm <= 1000; wavelength_nm += 5) {
            const Surface surface = library.surface({material.name}, wavelength_nm);
            const float all =
                surface.diffuse + surface.specular + surface.retro + surface.transmission;
            EXPECT_GT(all, 0.0F) << material.name;
            EXPECT_LE(all, 1.0F + 1e-6F) << material.name << " at " << wavelength_nm;
        }
    }
}

TEST(StockMaterials, LeaveAnUnnamedSurfaceAsItWas) {
    const MaterialLibrary library = stock();
    for (const char* name : {"default", "wall", "unknown"}) {
        for (const int wavelength_nm : {785, 830, 905})
            EXPECT_EQ(library.surface({name}, wavelength_nm), Surface{}) << name;
    }
}

/// ASTM D4956: the least coefficients of white sheeting; the cone as in sim/world/surface.h.
TEST(StockMaterials, SendBackWhatTheStandardsOfSheetingAsk) {
    const double cone_sr = 2.0 * std::numbers::pi * (1.0 - std::cos(std::numbers::pi / 180.0));
    const MaterialLibrary library = stock();
    EXPECT_NEAR(library.find("reflective_tape")->retro, 70.0 * cone_sr, 5e-4);
    EXPECT_NEAR(library.find("traffic_sign")->retro, 250.0 * cone_sr, 5e-4);
}

TEST(StockMaterials, MirrorAsMuchAsFresnelSays) {
    const MaterialLibrary library = stock();
    const auto fresnel = [](double n) { return (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0)); };
    EXPECT_NEAR(library.find("glass")->reflectance.at(905), fresnel(1.52), 5e-4);
    EXPECT_NEAR(library.find("acrylic")->reflectance.at(905), fresnel(1.484), 5e-4);
    EXPECT_NEAR(library.find("water")->reflectance.at(905), fresnel(1.33), 5e-4);
    EXPECT_NEAR(library.find("glass")->transmission * library.find("glass")->transmission, 0.83,
                1e-3);
}

TEST(StockMaterials, KnowEveryMaterialOfTheWorldsBesideThem) {
    SceneOptions options{.sdf = {.model_folders = {scenes / "models"}}};
    options.materials = std::make_shared<const MaterialLibrary>(stock());
    for (const char* world : {"rescue_maze.sdf", "square_room.sdf", "corridor.sdf", "crossing.sdf",
                              "depot.sdf", "office_map.yaml", "rescue_maze_terrain.obj"}) {
        EXPECT_THAT(load_scene(scenes / world, options).warnings, IsEmpty()) << world;
    }
}

/// A world of spheres of these materials.
std::string world_of(const std::string& visuals) {
    return "<?xml version='1.0'?>\n<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'><world "
           "name='w'><model name='m'><static>true</static><link name='l'>" +
           visuals + "</link></model></world></sdf>";
}

std::string sphere(const std::string& name, const std::string& more) {
    return "<visual name='" + name + "'>" + more +
           "<geometry><sphere><radius>1</radius></sphere></geometry></visual>";
}

class UnknownMaterials : public ::testing::Test {
  protected:
    std::vector<std::string> warnings(bool strict = false) {
        SceneOptions options;
        options.sdf.strict = strict;
        options.materials = std::make_shared<const MaterialLibrary>(stock());
        return load_scene(file_, options).warnings;
    }

    tests::TempDir dir_;
    const std::string cheese_ = "<scipd:material>cheese</scipd:material>";
    const std::filesystem::path file_ = dir_.write(
        "w.sdf",
        world_of(sphere("a", cheese_) + sphere("b", cheese_ + "<laser_retro>0.5</laser_retro>") +
                 sphere("c", cheese_ + "<transparency>0.5</transparency>") +
                 sphere("d", "<scipd:material>jelly</scipd:material>") +
                 sphere("e", "<scipd:material>OAK</scipd:material>") +
                 sphere("f", "<transparency>0.5</transparency>") + sphere("g", "")));
};

TEST_F(UnknownMaterials, GetOneWarningAName) {
    const std::string advice =
        "; describe it in a file that the configuration names under materials";
    EXPECT_THAT(warnings(),
                ElementsAre(file_.string() +
                                ": no library knows the material 'cheese', which is taken by its "
                                "laser_retro and transparency" +
                                advice,
                            file_.string() +
                                ": no library knows the material 'jelly', which is taken like an "
                                "unnamed one" +
                                advice));
}

TEST_F(UnknownMaterials, AreFaultsOfAStrictLoad) {
    try {
        (void)warnings(true);
        FAIL() << "was loaded";
    } catch (const LoadError& error) {
        EXPECT_EQ(error.faults().size(), 2U);
    }
}

TEST(NoLibrary, MissesNoNameWhereThereIsNone) {
    Scene scene;
    scene.models.push_back({"m"});
    const Material clear{.name = "", .appearance = {.transparency = 0.5}};
    for (const Material& material : {Material{}, clear})
        scene.objects.push_back({"o", 0, Pose{}, Sphere{1.0}, id_of(material, scene.materials)});
    EXPECT_THAT(unknown_materials(scene, MaterialLibrary{}, "w.sdf"), IsEmpty());
}

TEST(ManyUnknownMaterials, AreCountedBehindAHundred) {
    Scene scene;
    scene.models.push_back({"m"});
    for (int i = 0; i < 250; ++i) {
        const Material material{std::to_string(i)};
        scene.objects.push_back({"o", 0, Pose{}, Sphere{1.0}, id_of(material, scene.materials)});
    }
    const auto told = unknown_materials(scene, stock(), "w.sdf");
    ASSERT_EQ(told.size(), 101U);
    EXPECT_EQ(told.back(), "w.sdf: 150 more names of materials are unknown");
}

}  // namespace
}  // namespace scipd::sim
