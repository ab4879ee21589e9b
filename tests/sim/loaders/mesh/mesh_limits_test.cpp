// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mesh files that nobody means well with: refused, and nothing around them suffers.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/mesh/mesh_parts.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/mesh/whole_mesh.h"
#include "tests/support/sanitized.h"

namespace scipd::sim {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::StartsWith;

/// A COLLADA file of `levels` nodes, each of which shows the one below it ten times, and at the
/// bottom so many triangles.
std::string node_bomb(int levels, int triangles) {
    std::string corners;
    for (int i = 0; i < triangles; ++i)
        corners += "0 1 2 ";
    std::string nodes = "<node id=\"n0\"><instance_geometry url=\"#g\"/></node>\n";
    for (int level = 1; level <= levels; ++level) {
        nodes += "<node id=\"n" + std::to_string(level) + "\">";
        for (int i = 0; i < 10; ++i)
            nodes += "<instance_node url=\"#n" + std::to_string(level - 1) + "\"/>";
        nodes += "</node>\n";
    }
    return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
   <accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
   <param name="Y" type="float"/><param name="Z" type="float"/></accessor>
  </technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count=")" +
           std::to_string(triangles) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
           corners +
           R"(</p></triangles>
 </mesh></geometry></library_geometries>
 <library_nodes>)" +
           nodes + "</library_nodes><library_visual_scenes><visual_scene id=\"s\">" +
           "<node><instance_node url=\"#n" + std::to_string(levels) +
           "\"/></node></visual_scene></library_visual_scenes>" +
           "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

/// In glTF, whose reader follows children without end.
constexpr auto circle_of_nodes = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
                                 R"("nodes":[{"children":[1]},{"children":[0]}]})";

class MeshLimitsTest : public ::testing::Test {
  protected:
    std::vector<std::string> faults(const std::string& name, const std::string& text) {
        const auto file = folder_.write(name, text);
        return faults_of([&] { load_mesh(file); }, folder_);
    }
    TempDir folder_;
};

TEST_F(MeshLimitsTest, nodesThatShowEachOtherManyTimesAreSeenAsOften) {
    EXPECT_EQ(load_mesh(folder_.write("a.dae", node_bomb(3, 2))).triangles.size(), 2000U);
}

TEST_F(MeshLimitsTest, aSmallFileOfManyTrianglesIsRefused) {
    EXPECT_THAT(faults("a.dae", node_bomb(4, 3000)),
                ElementsAre("a.dae: has more than 10000000 triangles"));
}

TEST_F(MeshLimitsTest, aCircleOfNodesEndsNothingButItself) {
    EXPECT_THAT(faults("a.gltf", circle_of_nodes), ElementsAre(StartsWith("a.gltf: ")));
}

TEST_F(MeshLimitsTest, aHeaderThatPromisesTooMuch) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    EXPECT_THAT(faults("a.ply",
                       "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                       "property float x\nproperty float y\nproperty float z\n"
                       "element face 4000000000\nproperty list uchar int "
                       "vertex_indices\nend_header\nabc"),
                ElementsAre(StartsWith("a.ply: ")));
    EXPECT_THAT(faults("a.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(50, 'a')),
                ElementsAre(StartsWith("a.stl: ")));
}

// In whose header Assimp 5.2 goes round and round, and takes more memory every time. 5.4 refuses
// it.
TEST_F(MeshLimitsTest, aSmallFileGetsLittle) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    EXPECT_THAT(faults("a.ply",
                       "ply\nformat binary_little_endian 1.0\nelement float 4\n"
                       "property float x\n"),
                ElementsAre(AnyOf("a.ply: takes more than 1073 MB of memory",
                                  "a.ply: takes more than 5 s of processor time, or all memory",
                                  StartsWith("a.ply: crashes the library"),
                                  "a.ply: cannot be read as a mesh: Invalid .ply file: Unable to "
                                  "build DOM (#2)")));
}

TEST_F(MeshLimitsTest, aFileThatIsTooLargeIsNotEvenOpened) {
    const auto file = folder_.write("a.stl", "");
    std::filesystem::resize_file(file, (1ULL << 30) + 1);  // sparse: it takes no room
    EXPECT_THAT(faults_of([&] { load_mesh(file); }, folder_),
                ElementsAre("a.stl: is larger than 1 GiB"));
}

TEST_F(MeshLimitsTest, whatIsKeptInThePlaceOfAMeshIsCalledSo) {
    const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:1\n";
    for (const std::string name : {"a.dae", "a.stl", "a.obj", "a.glb", "a.gltf", "a.ply"}) {
        EXPECT_THAT(faults(name, pointer),
                    ElementsAre(name + ": is a pointer of Git LFS, no mesh; fetch the file itself "
                                       "with `git lfs pull`"));
        EXPECT_THAT(faults(name, "\n<!DOCTYPE html>\n<html></html>"),
                    ElementsAre(name + ": is a page of HTML, no mesh; download the file itself, "
                                       "not the page that shows it"));
    }
    const auto file = folder_.write("b.dae", pointer);
    EXPECT_THAT(faults_of([&] { load_submesh(file, "part"); }, folder_),
                ElementsAre(StartsWith("b.dae: is a pointer of Git LFS, no mesh")));
}

TEST_F(MeshLimitsTest, aSubmeshIsReadBehindTheSameOnes) {
    const auto submesh_faults = [&](const std::string& name, const std::string& text) {
        const auto file = folder_.write(name, text);
        return faults_of([&] { load_submesh(file, "part"); }, folder_);
    };
    EXPECT_THAT(submesh_faults("a.dae", node_bomb(4, 3000)),
                ElementsAre("a.dae: has more than 10000000 triangles"));
    EXPECT_THAT(submesh_faults("a.gltf", circle_of_nodes), ElementsAre(StartsWith("a.gltf: ")));
    EXPECT_THAT(submesh_faults("a.txt", ""), ElementsAre(StartsWith("a.txt: is no kind of mesh")));
    EXPECT_THAT(submesh_faults("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\no part\nf 1 2 3\n"),
                ElementsAre("a.obj: has a vertex that is not finite"));
}

// As an exporter writes a file that gives each face a material of its own.
TEST_F(MeshLimitsTest, aMaterialForEachOfVeryManyFacesIsRefused) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_take_time;
    std::string faces = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::string materials;
    for (int i = 0; i < 10'010; ++i) {
        materials += "newmtl m" + std::to_string(i) + "\n";
        faces += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    }
    folder_.write("a.mtl", materials);
    EXPECT_THAT(faults("a.obj", faces),
                ElementsAre("a.obj: has more than 10000 materials; let parts that look alike share "
                            "one"));
}

TEST_F(MeshLimitsTest, memoryIsThatOfTheCaller) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\no part\n";
    for (int i = 0; i < 100'000; ++i)
        text += "f 1 2 3\n";
    const auto file = folder_.write("a.obj", text);
    const glm::dvec3 scale{1.0};
    EXPECT_EQ(load_mesh_parts(file, scale)[0].mesh.triangles.size(), 100'000U);
    EXPECT_EQ(load_submesh(file, "part")[0].mesh.triangles.size(), 100'000U);
    const MeshLimits few{.triangles = 99'999};
    EXPECT_THAT(faults_of([&] { load_submesh(file, "part", few); }, folder_),
                ElementsAre("a.obj: has more than 99999 triangles"));
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    const MeshLimits little{.memory_bytes = 10'000'000};
    const auto refused = ElementsAre(
        "a.obj: takes more than 10 MB of memory; world_memory_mb "
        "under limits in the configuration allows more");
    EXPECT_THAT(
        faults_of([&] { load_mesh_parts(file, scale, MeshAxes::as_in_file, little); }, folder_),
        refused);
    EXPECT_THAT(faults_of([&] { load_submesh(file, "part", little); }, folder_), refused);
}

}  // namespace
}  // namespace scipd::sim
