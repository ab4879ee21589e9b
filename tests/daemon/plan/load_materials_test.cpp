// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The materials that a configuration names, what --check and a start tell of them, and which of two
// files counts.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "daemon/plan/load_world.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/program/check.h"
#include "sim/loaders/file/load_error.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class LoadMaterials : public testing::Test {
  protected:
    LoadMaterials() { dir_.write("room.sdf", room_of("cheese")); }

    static std::string room_of(const std::string& material) {
        return "<sdf version='1.9' xmlns:scipd='urn:scipd:sdf'><world name='w'><model name='m'>"
               "<link name='l'><visual name='v'><scipd:material>" +
               material +
               "</scipd:material><geometry><box><size>1 1 1</size></box></geometry></visual>"
               "</link></model></world></sdf>";
    }

    std::filesystem::path rig(const std::string& more, const std::string& accuracy = "material") {
        return dir_.write("rig.yaml",
                          "scene: room.sdf\n" + more +
                              "robots: {r: {sensors: {s: {model: UST-10LX, pty: auto, accuracy: " +
                              accuracy + "}}}}\n");
    }

    template <typename Call>
    static std::vector<std::string> faults_of(const Call& call) {
        try {
            call();
        } catch (const sim::LoadError& error) {
            return error.faults();
        }
        return {};
    }

    tests::TempDir dir_;
};

TEST_F(LoadMaterials, BeginsWithThoseThatComeWithScipd) {
    const auto [library, warnings] = load_materials({});
    EXPECT_THAT(warnings, IsEmpty());
    EXPECT_GE(library->materials().size(), 30U);
    EXPECT_NE(library->find("wood"), nullptr);
}

TEST_F(LoadMaterials, AddsAndReplacesEntryByEntry) {
    const std::size_t stock = load_materials({}).library->materials().size();
    Config config;
    config.materials = dir_.write("mine.yaml",
                                  "materials:\n"
                                  "  cheese: {reflectance: {905: 0.7}, assumed: true}\n"
                                  "  Wood: {reflectance: {905: 0.1}, assumed: true}\n"
                                  "  oak: {reflectance: {905: 0.2}, assumed: true}\n");
    const auto library = load_materials(config).library;
    EXPECT_EQ(library->materials().size(), stock + 2);
    EXPECT_FLOAT_EQ(library->surface({"cheese"}, 905).diffuse, 0.7F);
    EXPECT_FLOAT_EQ(library->surface({"wood"}, 905).diffuse, 0.1F);
    EXPECT_FLOAT_EQ(library->surface({"Gazebo/Wood"}, 905).diffuse, 0.1F);
    EXPECT_FLOAT_EQ(library->surface({"oak"}, 905).diffuse, 0.2F);
    EXPECT_GT(library->surface({"concrete"}, 905).diffuse, 0.0F);
}

TEST_F(LoadMaterials, TellsFaultsWithBothPlaces) {
    const auto mine = dir_.write("mine.yaml", "materials:\n  cheese: {gloss: 0}\n");
    const auto file = rig("materials: mine.yaml\n");
    EXPECT_THAT(faults_of([&] { (void)check(file); }),
                ElementsAre(file.string() + ":2: materials: " + mine.string() +
                            ":2: materials.cheese.gloss: must be an exponent from 1 to 1e6"));
    EXPECT_THAT(faults_of([&] { (void)make_plan(load_config(file)); }), testing::SizeIs(1));
}

TEST_F(LoadMaterials, ChecksTheNamesOfTheWorld) {
    const std::string unknown = "no library knows the material 'cheese'";
    Options strict;
    strict.overrides.strict = true;
    const std::string said = check(rig(""));
    EXPECT_THAT(said, HasSubstr(unknown));
    EXPECT_THAT(said, HasSubstr(", materials: " + summary_of(*load_materials({}).library)));
    EXPECT_THAT(faults_of([&] { (void)check(rig(""), strict); }), ElementsAre(HasSubstr(unknown)));
    EXPECT_THAT(faults_of([&] { (void)check(rig("strict: true\n")); }),
                ElementsAre(HasSubstr(unknown)));

    dir_.write("mine.yaml",
               "materials: {cheese: {reflectance: {905: 0.7}, source: a cow, assumed: [905]}}\n");
    EXPECT_THAT(check(rig("materials: mine.yaml\n"), strict), Not(HasSubstr(unknown)));
}

// Where no sensor sees light, no material matters.
TEST_F(LoadMaterials, ChecksNoNamesForSensorsThatSeeNoLight) {
    EXPECT_THAT(check(rig("strict: true\n", "sensor")), Not(HasSubstr("no library knows")));
}

TEST_F(LoadMaterials, GoesWithThePlanOfARig) {
    dir_.write("mine.yaml", "materials: {cheese: {reflectance: {905: 0.7}, assumed: true}}\n");
    EXPECT_THAT(make_plan(load_config(rig(""))).loaded.warnings,
                ElementsAre(HasSubstr("no library knows the material 'cheese'")));
    // A reload reads the file again.
    const RigPlan plan = make_plan(load_config(rig("materials: mine.yaml\n")));
    EXPECT_THAT(plan.loaded.warnings, IsEmpty());
    EXPECT_FLOAT_EQ(plan.materials->surface({"cheese"}, 905).diffuse, 0.7F);
    dir_.write("mine.yaml", "materials: {cheese: {reflectance: {905: 0.3}, assumed: true}}\n");
    EXPECT_FLOAT_EQ(make_plan(load_config(dir_.path() / "rig.yaml"))
                        .materials->surface({"cheese"}, 905)
                        .diffuse,
                    0.3F);
}

TEST(SummaryOfMaterials, SaysWhichShareIsAssumed) {
    sim::MaterialLibrary library;
    EXPECT_EQ(summary_of(library), "0 with 0 parameters, 0 % of them assumed (not measured)");
    library.add({.name = "a", .reflectance = {{905, 0.5}}, .numbers = 3, .assumed = 2});
    EXPECT_EQ(summary_of(library), "1 with 3 parameters, 67 % of them assumed (not measured)");
}

}  // namespace
}  // namespace scipd::daemon
