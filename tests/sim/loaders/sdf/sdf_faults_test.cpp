// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What load_sdf() says about files that it cannot use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/scene_file.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class SdfFaults : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& text) {
        const auto file = folder_.write("a.sdf", text);
        return faults_of([&] { load_sdf(file, {.strict = true}); }, folder_);
    }
    TempDir folder_;
};

const std::string nothing_seen =
    "a.sdf: holds nothing that a scanner could see; give a model a <visual> with a box, cylinder, "
    "sphere, plane or mesh";

TEST_F(SdfFaults, missingFilesAndFolders) {
    EXPECT_THAT(faults_of([&] { load_sdf(folder_.path() / "b.sdf"); }, folder_),
                ElementsAre("b.sdf: no such file; name an SDF world or model"));
    folder_.write("c/d", "");
    EXPECT_THAT(
        faults_of([&] { load_sdf(folder_.path() / "c"); }, folder_),
        ElementsAre("c: is a folder without a model.config that names an SDF file; name a file "
                    "or the folder of a model"));
}

TEST_F(SdfFaults, noWorld) {
    EXPECT_THAT(faults(sdf("")),
                ElementsAre("a.sdf: holds no <world>, and no <model> with a <link>"));
    EXPECT_THAT(faults("<robot name='r'/>"),
                ElementsAre("a.sdf: is a URDF without a <link>; give the robot one"));
    EXPECT_THAT(faults(sdf("<model name='m'><include><uri>gone.sdf</uri></include></model>")),
                ElementsAre(::testing::HasSubstr("there is no 'gone.sdf'"),
                            "a.sdf: its model 'm' has no <link>, and none of its includes could be "
                            "read"));
}

TEST_F(SdfFaults, nothingToSee) {
    EXPECT_THAT(faults(world("")), ElementsAre(nothing_seen));
    EXPECT_THAT(faults(world("<model name='m'><link name='l'/></model>")),
                ElementsAre(nothing_seen));
}

TEST_F(SdfFaults, onlyWhatIsNotSupported) {
    const auto relief = "<image><uri>a.png</uri></image>";
    EXPECT_THAT(faults(world(model_of(visual("v", relief)))),
                ElementsAre("a.sdf:5: m::l::v: <image> is not supported and left out, here and "
                            "elsewhere",
                            nothing_seen));
}

TEST_F(SdfFaults, brokenXmlNamesItsLine) {
    const auto all = faults("<sdf version='1.9'>\n<world name='w'>\n<model\n");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0],
              "a.sdf:3: is no XML that can be read: an element does not "
              "end with > or />");
}

TEST_F(SdfFaults, textInUtf16IsCalledSo) {
    const std::string text("\xFF\xFE<\0s\0d\0f\0/\0>\0", 14);
    EXPECT_THAT(faults(text), ElementsAre("a.sdf: is in UTF-16; save it as UTF-8"));
    folder_.write("b.sdf", text);
    EXPECT_THAT(faults(world("<include><uri>b.sdf</uri></include>")),
                ::testing::Contains(HasSubstr("b.sdf: is in UTF-16; save it as UTF-8")));
}

TEST_F(SdfFaults, everyFaultOfOurOwnAtOnce) {
    folder_.write("bad.obj", "v 0 0 0\n");
    const auto all = faults(world(
        model_of(visual("a", "<box><size>1 0 1</size></box>") +
                 visual("b", "<cylinder><radius>-1</radius><length>1</length></cylinder>") +
                 visual("c", mesh_of("none.obj")) + visual("d", mesh_of("bad.obj")) +
                 visual("e", "<sphere><radius>1e8</radius></sphere>") + visual("f", unit_box))));
    const std::string size = ": every size must be above 0 and at most 1e7 m";
    ASSERT_EQ(all.size(), 5U);
    EXPECT_EQ(all[0], "a.sdf:5: m::l::a" + size);
    EXPECT_EQ(all[1], "a.sdf:6: m::l::b" + size);
    EXPECT_EQ(all[2], "a.sdf:7: m::l::c: there is no 'none.obj' near " + folder_.path().string());
    EXPECT_THAT(all[3], HasSubstr("a.sdf:8: m::l::d: bad.obj: "));
    EXPECT_EQ(all[4], "a.sdf:9: m::l::e" + size);
}

TEST_F(SdfFaults, aBrokenMeshIsToldOncePerVisual) {
    folder_.write("bad.obj", "v 0 0 0\n");
    EXPECT_EQ(
        faults(world(model_of(visual("a", mesh_of("bad.obj")) + visual("b", mesh_of("bad.obj")))))
            .size(),
        2U);
}

TEST_F(SdfFaults, valuesThatCannotBeRead) {
    const auto bad_size = "<box><size>1 1 a</size></box>";
    EXPECT_THAT(faults(world(model_of(visual("v", bad_size)))),
                ElementsAre("a.sdf:5: m::l::v: its <size> '1 1 a' cannot be read: write 3 numbers, "
                            "with blanks between"));
    EXPECT_THAT(faults(world(model_of(visual("v", unit_box, "<pose>nan 0 0 0 0 0</pose>")))),
                ElementsAre("a.sdf:5: m::l::v: its <pose> 'nan 0 0 0 0 0' cannot be read: write 6 "
                            "numbers, with blanks between"));
}

TEST_F(SdfFaults, documentsWithoutAnElement) {
    for (const auto* text : {"", "<!l>", "<?xml version='1.0'?>", "<!-- <sdf/> -->", "text"})
        EXPECT_THAT(faults(text), ::testing::Not(::testing::IsEmpty())) << text;
}

TEST_F(SdfFaults, versionsThatAreNoNumbers) {
    EXPECT_THAT(faults("<sdf version='x'>" + model_of(visual("v", unit_box)) + "</sdf>"),
                ElementsAre("a.sdf:1: has a version that is not a number; it is read as SDF 1.12"));
}

TEST_F(SdfFaults, framesThatLeadNowhere) {
    EXPECT_THAT(faults(world("<model name='m'><pose relative_to='nowhere'/><link name='l'>" +
                             visual("v", unit_box) + "</link></model>")),
                ElementsAre("a.sdf:4: m: its pose is relative to 'nowhere', which is no frame"));
}

TEST_F(SdfFaults, includesThatLeadNowhere) {
    const std::string lost = "model://" + folder_.path().filename().string() + "-lost";
    EXPECT_THAT(faults(world("<include><uri>" + lost + "</uri></include>" +
                             model_of(visual("v", unit_box)))),
                ElementsAre("a.sdf:4: there is no '" + lost + "' near " + folder_.path().string() +
                            ", nor in GZ_SIM_RESOURCE_PATH, GAZEBO_MODEL_PATH, SDF_PATH, "
                            "ROS_PACKAGE_PATH or AMENT_PREFIX_PATH"));
}

// A box at 3e8 m once made all other things so coarse that most beams met nothing.
TEST_F(SdfFaults, whatLiesTooFarOut) {
    const std::string far = "<pose>3e8 0 -1 0 0 0</pose>";
    const std::string end = " lies at 3e+08 0 -1; everything must lie within 1e7 m of the origin";
    const std::string box = visual("v", unit_box);
    const auto one = [&](const std::string& model) { return faults(world(model)); };
    EXPECT_THAT(one("<model name='m'>" + far + "<link name='l'>" + box + "</link></model>"),
                ElementsAre("a.sdf:4: m:" + end));
    EXPECT_THAT(one("<model name='m'>\n<link name='l'>" + far + box + "</link></model>"),
                ElementsAre("a.sdf:5: m::l:" + end));
    EXPECT_THAT(one(model_of(visual("w", unit_box) + visual("v", unit_box, far))),
                ElementsAre("a.sdf:6: m::l::v:" + end));
    EXPECT_THAT(one("<model name='m'>\n<model name='n'>" + far + "<link name='l'>" + box +
                    "</link></model></model>"),
                ElementsAre("a.sdf:5: m::n:" + end));
    folder_.write("b.sdf", sdf("<model name='b'><link name='l'>" + box + "</link></model>"));
    EXPECT_THAT(one("<include><uri>b.sdf</uri>" + far + "</include>"),
                ElementsAre("a.sdf:4: b:" + end));
    // Each within it, and not so together.
    EXPECT_THAT(one("<model name='m'><pose>6e6 0 0 0 0 0</pose>\n<link name='l'><pose>6e6 0 0 0 0 "
                    "0</pose>" +
                    box + "</link></model>"),
                ElementsAre("a.sdf:5: m::l: lies at 1.2e+07 0 0; everything must lie within 1e7 m "
                            "of the origin"));
}

TEST_F(SdfFaults, whatTurnsNowhere) {
    EXPECT_THAT(faults(world("<model name='m'><pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0"
                             "</pose><link name='l'>" +
                             visual("v", unit_box) + "</link></model>")),
                IsEmpty());
    EXPECT_THAT(faults(world("<model name='m'><pose>1e400 0 0 0 0 0</pose><link name='l'>" +
                             visual("v", unit_box) + "</link></model>")),
                Not(IsEmpty()));
}

TEST_F(SdfFaults, meshesThatAreTooLarge) {
    folder_.write("a.obj", triangle_obj);
    const auto scaled = [&](const std::string& scale) {
        return faults(world(model_of(
            visual("v", "<mesh><uri>a.obj</uri><scale>" + scale + " 1 1</scale></mesh>"))));
    };
    EXPECT_THAT(scaled("9e6"), IsEmpty());
    const auto refused = ElementsAre(
        "a.sdf:5: m::l::v: a.obj: has a vertex that is not finite, or more than 1e7 m from its "
        "origin; is it in metres, and its scale right?");
    EXPECT_THAT(scaled("2e7"), refused);
    EXPECT_THAT(scaled("-1e300"), refused);
    folder_.write("b.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(faults_of([&] { load_scene(folder_.path() / "b.obj"); }, folder_),
                ElementsAre(HasSubstr("b.obj: has a vertex that is not finite, or more than 1e7")));
}

TEST_F(SdfFaults, robotsThatReachTooFar) {
    folder_.write("a.urdf",
                  "<robot name='r'><link name='a'/><link name='b'><visual><geometry><box size='1 1 "
                  "1'/></geometry></visual></link><joint name='j' type='fixed'><parent link='a'/>"
                  "<child link='b'/><origin xyz='0 3e8 0'/></joint></robot>");
    EXPECT_THAT(
        faults_of([&] { load_sdf(folder_.path() / "a.urdf", {.strict = true}); }, folder_),
        ElementsAre("a.urdf:1: r::b: lies at 0 3e+08 0; everything must lie within 1e7 m of "
                    "the origin"));
}

}  // namespace
}  // namespace scipd::sim
