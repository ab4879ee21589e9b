// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/materials/materials_file.h"

#include <sstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> faults_in(const std::string& text) {
    try {
        (void)parse_materials(text, "a.yaml");
    } catch (const LoadError& error) {
        return error.faults();
    }
    return {};
}

/// The faults of one entry whose map holds this.
std::vector<std::string> faults_of_entry(const std::string& inside) {
    return faults_in("materials:\n  wood: {" + inside + "}\n");
}

TEST(MaterialsFile, ReadsAnEntryWhole) {
    const auto materials = parse_materials(
        "materials:\n"
        "  birch:\n"
        "    reflectance: {785: 0.5, 905: 0.6}\n"
        "    specular: 0.1\n    gloss: 20\n    retro: 0.01\n    transmission: 0.2\n"
        "    roughness: 0.3\n    texture: 0.05\n"
        "    source: a walk in the woods\n"
        "    assumed: [905, gloss]\n"
        "    aliases: [Gazebo/Birch, paper tree]\n"
        "  coal: {reflectance: {905: 0.03}, assumed: true}\n",
        "a.yaml");
    ASSERT_EQ(materials.size(), 2U);
    const MaterialOptics& birch = materials.front();
    EXPECT_EQ(birch.name, "birch");
    EXPECT_THAT(birch.aliases, ElementsAre("Gazebo/Birch", "paper tree"));
    EXPECT_EQ(birch.reflectance, (std::map<int, double>{{785, 0.5}, {905, 0.6}}));
    EXPECT_EQ(birch.specular, 0.1);
    EXPECT_EQ(birch.gloss, 20.0);
    EXPECT_EQ(birch.retro, 0.01);
    EXPECT_EQ(birch.transmission, 0.2);
    EXPECT_EQ(birch.roughness, 0.3);
    EXPECT_EQ(birch.texture, 0.05);
    EXPECT_EQ(birch.source, "a walk in the woods");
    EXPECT_EQ(birch.numbers, 8U);
    EXPECT_EQ(birch.assumed, 2U);
    EXPECT_EQ(materials.back().numbers, 1U);
    EXPECT_EQ(materials.back().assumed, 1U);
}

TEST(MaterialsFile, TellsWhatIsNoLibrary) {
    const auto no_library =
        HasSubstr("a.yaml:1: is no library of materials, which has `materials:");
    EXPECT_THAT(faults_in(""), ElementsAre(no_library));
    EXPECT_THAT(faults_in("wood"), ElementsAre(no_library));
    EXPECT_THAT(faults_in("- wood"), ElementsAre(no_library));
    EXPECT_THAT(faults_in("\nwood: {}"),
                ElementsAre("a.yaml:2: wood: unknown key; known here is materials"));
    EXPECT_THAT(faults_in("materials: 3"),
                ElementsAre("a.yaml:1: materials: must be a map of 1 to 4096 names and what they "
                            "mean"));
    EXPECT_THAT(faults_in("materials: {wood"), ElementsAre(HasSubstr("a.yaml:1: not YAML: ")));
    EXPECT_THAT(faults_in(std::string(10'000, '[')), ElementsAre(HasSubstr("a.yaml:")));
}

TEST(MaterialsFile, TellsEachFaultWithLineAndKey) {
    const std::pair<const char*, const char*> cases[] = {
        {"reflectance: 0.5", "reflectance: must be a map of wavelengths in nm and shares"},
        {"reflectance: {}", "reflectance: must be a map of wavelengths in nm and shares"},
        {"reflectance: {200: 0.5}", "reflectance.200: must be a wavelength in whole nm, 300 to"},
        {"reflectance: {905.5: 0.5}", "reflectance.905.5: must be a wavelength in whole nm"},
        {"reflectance: {905: 1.1}", "reflectance.905: must be a share from 0 to 1"},
        {"reflectance: {905: .nan}", "reflectance.905: must be a share from 0 to 1"},
        {"reflectance: {905: {}}", "reflectance.905: must be a share from 0 to 1"},
        {"reflectance: {905: 0.1, 905: 0.2}", "reflectance.905: given twice, first in line 2"},
        {"specular: -0.1", "specular: must be a share from 0 to 1"},
        {"gloss: 0.5", "gloss: must be an exponent from 1 to 1e6"},
        {"retro: 2", "retro: must be a share from 0 to 1"},
        {"transmission: much", "transmission: must be a share from 0 to 1"},
        {"roughness: 1.6", "roughness: must be an angle in rad, 0 to 1.57"},
        {"texture: [1]", "texture: must be a share from 0 to 1"},
        {"source: ''", "source: must say where the numbers come from"},
        {"source: {}", "source: must say where the numbers come from"},
        {"assumed: perhaps", "assumed: must be true, or a list of keys and wavelengths"},
        {"assumed: {gloss: 1}", "assumed: must be true, or a list of keys and wavelengths"},
        {"assumed: [colour]", "assumed: 'colour' is no key with a number and no wavelength"},
        {"aliases: oak", "aliases: must be a list of names"},
        {"aliases: [{}]", "aliases: must be a list of names"},
        {"aliases: ['']", "aliases: a name must have 1 to 200 bytes"},
        {"colour: red", "colour: unknown key; known here are reflectance, specular"},
        {"? [1] : 2", "a key must be a plain name"},
    };
    for (const auto& [inside, fault] : cases) {
        const auto found = faults_of_entry(inside);
        ASSERT_EQ(found.size(), 1U) << inside;
        EXPECT_THAT(found.front(), HasSubstr("a.yaml:2: materials.wood")) << inside;
        EXPECT_THAT(found.front(), HasSubstr(fault)) << inside;
    }
}

TEST(MaterialsFile, AsksForAReflectanceAndForSources) {
    EXPECT_THAT(faults_of_entry("gloss: 3, assumed: true"),
                ElementsAre("a.yaml:2: materials.wood: needs a reflectance"));
    const auto no_source = HasSubstr("a.yaml:2: materials.wood: needs a source that says where");
    EXPECT_THAT(faults_of_entry("reflectance: {905: 0.5}"), ElementsAre(no_source));
    EXPECT_THAT(faults_of_entry("reflectance: {905: 0.5}, gloss: 3, assumed: [gloss]"),
                ElementsAre(no_source));
    EXPECT_THAT(faults_of_entry("reflectance: {905: 0.5}, gloss: 3, assumed: [gloss, 905]"),
                ElementsAre());
    EXPECT_THAT(faults_of_entry("reflectance: {905: 0.5}, gloss: 3, source: a book"),
                ElementsAre());
}

TEST(MaterialsFile, RefusesAFaceThatGivesBackMoreThanFallsOnIt) {
    EXPECT_THAT(
        faults_of_entry("reflectance: {785: 0.5, 905: 0.6}, retro: 0.2, transmission: 0.3, "
                        "assumed: true"),
        ElementsAre("a.yaml:2: materials.wood: reflectance, retro and transmission are 1.100 "
                    "together at 905 nm; no face gives back more than falls on it, so keep to 1"));
}

TEST(MaterialsFile, RefusesANameThatIsTaken) {
    const std::string entry = "{reflectance: {905: 0.5}, assumed: true, aliases: [";
    EXPECT_THAT(faults_in("materials:\n  wood: " + entry + "oak]}\n  Wood: " + entry + "Oak]}\n"),
                ElementsAre("a.yaml:3: materials.Wood: the name 'Wood' is taken in line 2; use "
                            "another (case does not count)",
                            "a.yaml:3: materials.Wood.aliases: the name 'Oak' is taken in line 2; "
                            "use another (case does not count)"));
}

TEST(MaterialsFile, TellsManyFaultsAtOnceButNotWithoutEnd) {
    std::string text = "materials:\n  wood: {specular: 2, gloss: 0, colour: red}\n";
    EXPECT_EQ(faults_in(text).size(), 3U);
    for (int i = 0; i < 1000; ++i)
        text += std::string(2, ' ').append(std::to_string(i)).append(": {gloss: 0}\n");
    EXPECT_EQ(faults_in(text).size(), 101U);
    EXPECT_THAT(faults_in(text), Contains(HasSubstr("too many faults")));
}

// Aliases of YAML that stand for ten times as much each.
TEST(MaterialsFile, EndsOnAYamlBomb) {
    std::ostringstream text;
    text << "materials: &a0 {x: {gloss: 0}}\n";
    for (int i = 1; i < 40; ++i) {
        text << 'k' << i << ": &a" << i << " {";
        for (char c = 'a'; c < 'k'; ++c)
            text << c << ": *a" << i - 1 << ", ";
        text << "}\n";
    }
    EXPECT_EQ(faults_in(text.str()).size(), 40U);
    EXPECT_THAT(faults_in("materials: &m {wood: *m}\n"), ElementsAre(HasSubstr("a.yaml:1:")));
}

}  // namespace
}  // namespace scipd::sim
