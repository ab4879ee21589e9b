// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds with faults: what has the fault is left out, told with its place, and all else is scanned.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::string link(const std::string& name, const std::string& inside) {
    return "<link name='" + name + "'>" + inside + "</link>\n";
}

std::string model(const std::string& name, const std::string& inside) {
    return "<model name='" + name + "'>" + inside + "</model>\n";
}

class SdfRepair : public ::testing::Test {
  protected:
    /// Names all that is seen in these models, beside one that has no fault, which is not listed.
    std::vector<std::string> seen(const std::string& models) {
        const std::string text = world(model("ok", link("l", visual("v", unit_box))) + models);
        const auto file = folder_.write("a.sdf", text);
        auto loaded = load_scene(file);
        warnings_ = without_folder(std::move(loaded.warnings), folder_);
        scene_ = loaded.scene;
        std::vector<std::string> names;
        for (const Object& object : scene_->objects)
            names.push_back(object.name);
        EXPECT_THAT(names, ::testing::Contains("ok::l::v"));
        std::erase(names, "ok::l::v");
        return names;
    }

    /// That a strict load tells of it too, and loads nothing.
    void expect_strict_faults() {
        EXPECT_THAT(
            faults_of([&] { load_scene(folder_.path() / "a.sdf", {.sdf = {.strict = true}}); },
                      folder_),
            Not(IsEmpty()));
    }

    TempDir folder_;
    std::vector<std::string> warnings_;
    SharedScene scene_;
};

// What stands before it takes five lines.
TEST_F(SdfRepair, AVisualGoesAlone) {
    const auto lost = [&](const std::string& first, const std::string& why) {
        SCOPED_TRACE(first);
        EXPECT_THAT(seen(model("m", link("l", "\n" + first + visual("b", unit_box)))),
                    ElementsAre("m::l::b"));
        EXPECT_THAT(warnings_, ElementsAre("a.sdf:8: m::l::a: " + why + "; left out"));
        expect_strict_faults();
    };
    const std::string three = ": write 3 numbers, with blanks between";
    lost(visual("a", "<box><size>1 1 a</size></box>"), "its <size> '1 1 a' cannot be read" + three);
    lost(visual("a", "<box><size>1 1</size></box>"), "its <size> '1 1' cannot be read" + three);
    lost(visual("a", "<box><size/></box>"), "its <size> cannot be read" + three);
    lost(visual("a", "<sphere><radius>r</radius></sphere>"),
         "its <radius> 'r' cannot be read: write a number");
    // Numbers that are glued together, as a public world has them.
    lost(visual("a", unit_box, "<pose>3-0.5 1 0 0 0</pose>"),
         "its <pose> '3-0.5 1 0 0 0' cannot be read: write 6 numbers, with blanks between");
}

TEST_F(SdfRepair, ALinkOrAModelGoesWithItsPose) {
    EXPECT_THAT(seen(model("m", link("k", "<pose>nan 0 0 0 0 0</pose>" + visual("a", unit_box)) +
                                    link("l", visual("b", unit_box)))),
                ElementsAre("m::l::b"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m::k: its <pose> 'nan 0 0 0 0 0' cannot be read")));
    EXPECT_THAT(seen(model("m", "<pose>1e999 0 0 0 0 0</pose>" + link("l", visual("b", unit_box)))),
                IsEmpty());
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m: its <pose> '1e999 0 0 0 0 0' cannot be read")));
}

TEST_F(SdfRepair, WhatIsNeitherShapeNorPlaceCostsItselfOnly) {
    EXPECT_THAT(seen(model("m", "<static>maybe</static>" +
                                    link("l",
                                         "<visual name='v'><laser_retro>x</laser_retro>"
                                         "<geometry>" +
                                             unit_box + "</geometry></visual>"))),
                ElementsAre("m::l::v"));
    EXPECT_THAT(
        warnings_,
        ElementsAre(
            HasSubstr("m: its <static> 'maybe' cannot be read: write true or false; ignored"),
            HasSubstr("m::l::v: its <laser_retro> 'x' cannot be read: write a number; ignored")));
}

TEST_F(SdfRepair, FramesThatAreNotThere) {
    const std::string box = visual("v", unit_box);
    EXPECT_THAT(seen(model("m", "<pose relative_to='no'/>" + link("l", box))), IsEmpty());
    EXPECT_THAT(
        warnings_,
        ElementsAre("a.sdf:7: m: its pose is relative to 'no', which is no frame; left out"));
    EXPECT_THAT(seen(model("m", link("k", "<pose relative_to='no'/>" + box) + link("l", box))),
                ElementsAre("m::l::v"));
    EXPECT_THAT(
        warnings_,
        ElementsAre(HasSubstr("a.sdf:7: m::k: its pose is relative to 'no', which is no frame")));
    // A frame takes with it what lies in it.
    EXPECT_THAT(seen(model("m", "<frame name='f' attached_to='no'/>" + link("l", box) +
                                    link("k", "<pose relative_to='f'/>" + box))),
                ElementsAre("m::l::v"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m::k: its pose is relative to 'f', which lies nowhere"),
                            HasSubstr("m::f: it is attached to 'no', which is no frame")));
    EXPECT_THAT(seen("<model name='m' placement_frame='no'>" + link("l", box) + "</model>"),
                IsEmpty());
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m: its placement_frame is 'no', which is no frame")));
    EXPECT_THAT(seen("<model name='m' canonical_link='no'>" + link("l", box) + "</model>"),
                ElementsAre("m::l::v"));
}

TEST_F(SdfRepair, FramesThatGoInCircles) {
    const std::string box = visual("v", unit_box);
    EXPECT_THAT(seen(model("m", link("k", "<pose relative_to='l'/>" + box) +
                                    link("l", "<pose relative_to='k'/>" + box)) +
                     model("n", link("l", box))),
                ElementsAre("n::l::v"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m::k: its pose leads in a circle"),
                            HasSubstr("m::l: its pose is relative to 'k', which lies nowhere")));
    EXPECT_THAT(seen(model("m", link("k", "<pose relative_to='k'/>" + box) + link("l", box))),
                ElementsAre("m::l::v"));
}

TEST_F(SdfRepair, JointsThatHoldNothing) {
    EXPECT_THAT(seen(model("m", link("k", visual("a", unit_box)) +
                                    link("l", "<pose relative_to='j'/>" + visual("b", unit_box)) +
                                    "<joint name='j' type='fixed'><pose relative_to='k'/>"
                                    "<parent>no</parent><child>l</child></joint>")),
                ElementsAre("m::k::a", "m::l::b"));
    // Where it is needs its child alone.
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_THAT(seen(model("m", link("k", visual("a", unit_box)) +
                                    link("l", "<pose relative_to='j'/>" + visual("b", unit_box)) +
                                    "<joint name='j' type='fixed'><pose relative_to='k'/>"
                                    "<parent>k</parent><child>no</child></joint>")),
                ElementsAre("m::k::a"));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("m::l: its pose is relative to 'j', which lies "
                                                 "nowhere")));
}

TEST_F(SdfRepair, NamesThatAreMissingOrTaken) {
    const std::string box = visual("v", unit_box);
    folder_.write("inc.sdf", sdf(model("inc", link("l", box))));
    const std::string include = "<include><uri>inc.sdf</uri></include>\n";
    EXPECT_THAT(seen(include + include + model("m", link("l", box + box) + link("l", box))),
                ElementsAre("inc::l::v", "inc_0::l::v", "m::l::v", "m::l::v_0", "m::l_0::v"));
    EXPECT_THAT(warnings_,
                ElementsAre("a.sdf:10: there is another visual m::l::v; this one is called v_0",
                            "a.sdf:12: there is another link m::l; this one is called l_0",
                            "a.sdf:8: there is another model inc; this one is called inc_0"));
    expect_strict_faults();
    EXPECT_THAT(
        seen("<model><link>" + visual("", unit_box) + "</link>" + link("world", box) + "</model>"),
        ElementsAre("model_0::link_0::visual_0", "model_0::world::v"));
    EXPECT_THAT(warnings_, SizeIs(3));
}

TEST_F(SdfRepair, WhatIsIncludedIsMendedInItsOwnFile) {
    folder_.write("inc.sdf",
                  sdf(model("inc", link("l", visual("a", "<box><size>1 1 a</size></box>") +
                                                 visual("b", unit_box)))));
    EXPECT_THAT(seen("<include><uri>inc.sdf</uri></include>"), ElementsAre("inc::l::b"));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("inc.sdf:3: inc::l::a: its <size> ")));
    // One that includes itself is there once.
    folder_.write("inc.sdf", sdf(model("inc", link("l", visual("b", unit_box)) +
                                                  "<include><uri>inc.sdf</uri></include>")));
    EXPECT_THAT(seen("<include><uri>inc.sdf</uri></include>"), ElementsAre("inc::l::b"));
    EXPECT_THAT(warnings_, ElementsAre("inc.sdf:5: includes itself; left out"));
    // A model of nothing but what is missing.
    EXPECT_THAT(seen(model("m", "<include><uri>gone.sdf</uri></include>")), IsEmpty());
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:7: there is no 'gone.sdf'")));
    EXPECT_THAT(seen("<include/>"), IsEmpty());
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:7: an <include> has no <uri>")));
}

TEST_F(SdfRepair, ManyFaultsAtOnce) {
    std::string models;
    for (int i = 0; i < 40; ++i) {
        const std::string pose = i % 4 == 0 ? "0 0 0 0 0 0" : i % 4 == 1 ? "x" : "1 2 3";
        models += model(std::string{"m"}.append(std::to_string(i)),
                        "<pose>" + pose + "</pose>" + link("l", visual("v", unit_box)));
    }
    EXPECT_THAT(seen(models), SizeIs(10));
    EXPECT_THAT(warnings_, SizeIs(30));
}

TEST_F(SdfRepair, TheRestIsWhereItWas) {
    EXPECT_THAT(seen(model("m", "<pose>5 0 0 0 0 0</pose>" +
                                    link("l", visual("a", "<box><size>q</size></box>") +
                                                  visual("b", unit_box,
                                                         "<pose>1 0 0 0 0 0"
                                                         "</pose>")))),
                ElementsAre("m::l::b"));
    const glm::vec3 along{1, 0, 0};
    const Pose pose{{2, 0, 0}, {1, 0, 0, 0}};
    for (const char* name : {"reference", "embree"}) {
        Hit hit;
        make_backend(name, scene_)
            ->cast({.directions = {&along, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
        EXPECT_NEAR(hit.range_m, 3.5, 1e-5) << name;
    }
}

class SdfKind : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& text) {
        const auto file = folder_.write("a.sdf", text);
        return faults_of([&] { load_scene(file); }, folder_);
    }
    TempDir folder_;
};

TEST_F(SdfKind, WhatIsNoSdfIsCalledSo) {
    EXPECT_THAT(faults("<!DOCTYPE html>\n<html><br></html>"),
                ElementsAre(HasSubstr("a.sdf:1: is a page of HTML, no SDF")));
    EXPECT_THAT(faults("\n<HTML></HTML>"), ElementsAre(HasSubstr("is a page of HTML, no SDF")));
    EXPECT_THAT(faults("version https://git-lfs.github.com/spec/v1\noid sha256:1\n"),
                ElementsAre(HasSubstr("a.sdf:1: is a pointer of Git LFS, no SDF")));
    EXPECT_THAT(faults("404: Not Found"),
                ElementsAre("a.sdf:1: is no SDF; it begins with '404: Not Found', and an SDF file "
                            "begins with <sdf>"));
    EXPECT_THAT(faults("<?xml version='1.0'?>\n<mujoco/>"),
                ElementsAre("a.sdf:2: is no SDF: its root is <mujoco>, not <sdf>"));
}

TEST_F(SdfKind, VersionsThatAreNone) {
    for (const std::string version : {"", " version='x'", " version='2'"}) {
        folder_.write("a.sdf", "<sdf" + version + ">" + model_of(visual("v", unit_box)) + "</sdf>");
        const auto loaded = load_scene(folder_.path() / "a.sdf");
        EXPECT_THAT(loaded.scene->objects, SizeIs(1));
        EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("it is read as SDF 1.12")));
    }
}

}  // namespace
}  // namespace scipd::sim
