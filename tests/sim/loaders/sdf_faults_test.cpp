// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What load_sdf() says about files that it cannot use. Texts in the library's words are its own
// (version 12).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SdfFaults : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& text) {
        const auto file = folder_.write("a.sdf", text);
        return faults_of([&] { load_sdf(file); }, folder_);
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
    EXPECT_THAT(faults_of([&] { load_sdf(folder_.path() / "c"); }, folder_),
                ElementsAre("c: is a directory; name an SDF world or model"));
}

TEST_F(SdfFaults, noWorld) {
    EXPECT_THAT(faults(sdf("")), ElementsAre("a.sdf: holds no <world> and no <model>"));
}

TEST_F(SdfFaults, nothingToSee) {
    EXPECT_THAT(faults(world("")), ElementsAre(nothing_seen));
    EXPECT_THAT(faults(world("<model name='m'><link name='l'/></model>")),
                ElementsAre(nothing_seen));
}

TEST_F(SdfFaults, onlyWhatIsNotSupported) {
    const auto heightmap = "<heightmap><uri>a.png</uri></heightmap>";
    EXPECT_THAT(faults(world(model_of(visual("v", heightmap)))),
                ElementsAre("a.sdf:5: m::l::v: <heightmap> is not supported and left out, here and "
                            "elsewhere",
                            nothing_seen));
}

TEST_F(SdfFaults, brokenXmlNamesItsLine) {
    const auto all = faults("<sdf version='1.9'>\n<world name='w'>\n<model\n");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_THAT(all[0], HasSubstr("a.sdf: Error parsing XML in file [a.sdf]"));
    EXPECT_THAT(all[0], HasSubstr("Line number=3"));
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

TEST_F(SdfFaults, theLibrarysFaultsWithoutItsEchoes) {
    const auto bad_size = "<box><size>1 1 a</size></box>";
    EXPECT_THAT(faults(world(model_of(visual("v", bad_size)))),
                ElementsAre("a.sdf: Unknown error. Unable to set value [1 1 a ] for key[size]",
                            "a.sdf:5: Error reading element <size> "
                            "(/sdf/world[@name=\"w\"]/model[@name=\"m\"]/link[@name=\"l\"]/"
                            "visual[@name=\"v\"]/geometry/box/size)"));
    EXPECT_THAT(faults(world(model_of(visual("v", unit_box, "<pose>nan 0 0 0 0 0</pose>")))),
                ElementsAre("a.sdf: Pose values must be finite.",
                            "a.sdf:5: Error reading element <pose> "
                            "(/sdf/world[@name=\"w\"]/model[@name=\"m\"]/link[@name=\"l\"]/"
                            "visual[@name=\"v\"]/pose)"));
}

TEST_F(SdfFaults, documentsWithoutAnElement) {
    for (const auto* text : {"", "<!l>", "<?xml version='1.0'?>", "<!-- <sdf/> -->", "text"})
        EXPECT_THAT(faults(text), ::testing::Not(::testing::IsEmpty())) << text;
}

TEST_F(SdfFaults, versionsThatAreNoNumbers) {
    EXPECT_THAT(faults("<sdf version='x'>" + model_of(visual("v", unit_box)) + "</sdf>"),
                ElementsAre("a.sdf: libsdformat cannot read it: stoi"));
}

TEST_F(SdfFaults, framesThatLeadNowhere) {
    EXPECT_THAT(faults(world("<model name='m'><pose relative_to='nowhere'/><link name='l'>" +
                             visual("v", unit_box) + "</link></model>")),
                ElementsAre("a.sdf: relative_to name[nowhere] specified by model with name[m] does "
                            "not match a model or frame name in world with name[w]."));
}

TEST_F(SdfFaults, includesThatLeadNowhere) {
    const std::string lost = "model://" + folder_.path().filename().string() + "-lost";
    EXPECT_THAT(faults(world("<include><uri>" + lost + "</uri></include>" +
                             model_of(visual("v", unit_box)))),
                ElementsAre("a.sdf:4: there is no '" + lost + "' near " + folder_.path().string() +
                            ", nor in GZ_SIM_RESOURCE_PATH, GAZEBO_MODEL_PATH, SDF_PATH, "
                            "ROS_PACKAGE_PATH or AMENT_PREFIX_PATH"));
}

}  // namespace
}  // namespace scipd::sim
