// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which part of a COLLADA a name means: that of Gazebo, which goes by the names of nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/mesh/mesh_parts.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/mesh/whole_mesh.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// A node whose triangle lies so far along x; `more` lies in it.
std::string node(const std::string& attributes, int x, const std::string& more = {}) {
    return "<node " + attributes + "><translate>" + std::to_string(x) +
           " 0 0</translate><instance_geometry url='#shape'/>" + more + "</node>";
}

class SubmeshTest : public ::testing::Test {
  protected:
    explicit SubmeshTest() {
        file_ = folder_.write(
            "a.dae",
            "<?xml version='1.0'?><COLLADA "
            "xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
            "<asset><up_axis>Z_UP</up_axis></asset><library_geometries>"
            "<geometry id='shape' name='Triangle'><mesh><source id='p'><float_array id='a' "
            "count='9'>0 0 0 0.1 0 0 0 0.1 0</float_array><technique_common><accessor source='#a' "
            "count='3' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
            "<param name='Z' type='float'/></accessor></technique_common></source>"
            "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
            "<triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
            "<p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
            "<library_visual_scenes><visual_scene id='s'>" +
                node("id='n1' name='table'", 1, node("name='leg'", 10) + node("", 20)) +
                "<node name='group'>" + node("name='part'", 2) + node("name='piece'", 3) +
                "</node>" + node("id='only_id'", 4) + node("id='x' name='both'", 5) +
                node("id='both' name='y'", 6) +
                "</visual_scene></library_visual_scenes>"
                "<scene><instance_visual_scene url='#s'/></scene></COLLADA>");
    }

    /// Where along x the triangles lie that a name means.
    std::vector<int> places(const std::string& name) {
        std::vector<int> places;
        for (const auto& part : load_submesh(file_, name)) {
            for (const auto& triangle : part.mesh.triangles) {
                const auto& corners = part.mesh.vertices_m;
                places.push_back(static_cast<int>(std::min(
                    {corners[triangle[0]].x, corners[triangle[1]].x, corners[triangle[2]].x})));
            }
        }
        return places;
    }

    tests::TempDir folder_;
    std::filesystem::path file_;
};

// What has no name belongs to the node around it, what has one does not.
TEST_F(SubmeshTest, aNodeByItsName) {
    EXPECT_THAT(places("table"), UnorderedElementsAre(1, 21));
    EXPECT_THAT(places("leg"), ElementsAre(11));
    EXPECT_THAT(places("part"), ElementsAre(2));
}

TEST_F(SubmeshTest, aNodeThatOnlyHoldsOthers) {
    EXPECT_THAT(places("group"), UnorderedElementsAre(2, 3));
}

TEST_F(SubmeshTest, aGeometryByItsName) {
    EXPECT_THAT(places("Triangle"), UnorderedElementsAre(1, 11, 21, 2, 3, 4, 5, 6));
}

TEST_F(SubmeshTest, namesGoBeforeIds) {
    EXPECT_THAT(places("both"), ElementsAre(5));
    EXPECT_THAT(places("n1"), ElementsAre(1, 11, 21));
    EXPECT_THAT(places("only_id"), ElementsAre(4));
}

TEST_F(SubmeshTest, noNameIsCutShort) {
    const std::string name(300, 'n');
    EXPECT_THAT(faults_of([&] { places(name); }, folder_),
                ElementsAre(::testing::HasSubstr("has no submesh '" + name + "'; there are")));
}

TEST_F(SubmeshTest, aNameOfNothingIsToldWhatThereIs) {
    EXPECT_THAT(
        faults_of([&] { places("none"); }, folder_),
        ElementsAre(::testing::StartsWith("a.dae: has no submesh 'none'; there are "
                                          "'Scene', 'Triangle', 'both', 'group', 'leg', ")));
}

}  // namespace
}  // namespace scipd::sim
