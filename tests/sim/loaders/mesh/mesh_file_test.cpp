// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <array>
#include <cstring>
#include <limits>

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/mesh/mesh_parts.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/mesh/whole_mesh.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;

/// One triangle of a binary STL with legs of 1 m along y and `z_m` along z, at x = 2.
std::string binary_stl(float z_m) {
    std::string bytes(80, '\0');
    const auto put = [&bytes](const auto& value) {
        std::array<char, sizeof value> raw{};
        std::memcpy(raw.data(), &value, sizeof value);
        bytes.append(raw.data(), raw.size());
    };
    put(std::uint32_t{1});
    for (const float f : {1.F, 0.F, 0.F, 2.F, 0.F, 0.F, 2.F, 1.F, 0.F, 2.F, 0.F, z_m})
        put(f);
    put(std::uint16_t{0});
    return bytes;
}

constexpr auto two_materials_obj =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\n"
    "usemtl oak\nf 1 2 3 4\n"
    "usemtl steel\nf 1 2 5\n"
    "usemtl oak\nf 2 3 5\n";

glm::dvec3 extent(const Mesh& mesh) {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high = -low;
    for (const auto& vertex : mesh.vertices_m) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
    }
    return high - low;
}

TEST(MeshFile, quadsBecomeTriangles) {
    const TempDir folder;
    const auto mesh = load_mesh(folder.write("a.obj", two_materials_obj));
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(extent(mesh), glm::dvec3(2.0, 1.0, 3.0));
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            EXPECT_LT(triangle[i], mesh.vertices_m.size());
    }
}

TEST(MeshFile, materialsStayApartByName) {
    const TempDir folder;
    const auto parts = load_mesh_parts(folder.write("a.obj", two_materials_obj));
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].material, "oak");
    EXPECT_EQ(parts[0].mesh.triangles.size(), 3U);
    EXPECT_EQ(parts[1].material, "steel");
    EXPECT_EQ(parts[1].mesh.triangles.size(), 1U);
}

TEST(MeshFile, noMaterialIsNoName) {
    const TempDir folder;
    const auto parts =
        load_mesh_parts(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].material, "");
}

TEST(MeshFile, verticesAreSharedAndScaled) {
    const TempDir folder;
    const auto mesh = load_mesh(
        folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), {2.0, 3.0, 4.0});
    EXPECT_EQ(mesh.vertices_m.size(), 4U);
    EXPECT_EQ(extent(mesh), glm::dvec3(2.0, 3.0, 0.0));
}

TEST(MeshFile, readsBinaryStl) {
    const TempDir folder;
    const auto mesh = load_mesh(folder.write("a.stl", binary_stl(1.F)));
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_THAT(mesh.vertices_m, ::testing::UnorderedElementsAre(
                                     glm::vec3(2, 0, 0), glm::vec3(2, 1, 0), glm::vec3(2, 0, 1)));
}

TEST(MeshFile, readsPly) {
    const TempDir folder;
    const auto mesh =
        load_mesh(folder.write("a.ply",
                               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float "
                               "x\nproperty float y\nproperty float z\n"
                               "element face 1\nproperty list uchar int "
                               "vertex_indices\nend_header\n0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n"));
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.vertices_m[0].z, 5.F);
}

TEST(MeshFile, colladaKeepsItsAxesAndAppliesItsTransforms) {
    const TempDir folder;
    // A triangle in a file that says z up, inside a node moved by 10 m along z.
    const auto mesh = load_mesh(folder.write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
   <accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
   <param name="Y" type="float"/><param name="Z" type="float"/></accessor>
  </technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node><translate>0 0 10</translate>
 <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
    EXPECT_THAT(mesh.vertices_m,
                ::testing::UnorderedElementsAre(glm::vec3(0, 0, 10), glm::vec3(1, 0, 10),
                                                glm::vec3(0, 1, 10)));
}

TEST(MeshFile, refusesWhatIsNoMesh) {
    const TempDir folder;
    const auto faults = [&](const std::string& name, std::string_view text) {
        return faults_of([&] { load_mesh(folder.write(name, text)); }, folder);
    };
    EXPECT_THAT(faults_of([&] { load_mesh(folder.path() / "none.obj"); }, folder),
                ElementsAre("none.obj: no such file; a mesh is wanted here"));
    EXPECT_THAT(faults("a.txt", "hello"),
                ElementsAre("a.txt: is no kind of mesh that is known; name one of .obj, .stl, "
                            ".ply, .dae, .gltf, .glb"));
    EXPECT_EQ(faults("empty.obj", "").size(), 1U);
    EXPECT_EQ(faults("points.obj", "v 0 0 0\nv 1 1 1\n").size(), 1U);
    EXPECT_EQ(faults("lines.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n").size(), 1U);
    EXPECT_EQ(faults("short.stl", binary_stl(1.F).substr(0, 100)).size(), 1U);
}

TEST(MeshFile, saysWhatHasNoFaces) {
    const TempDir folder;
    const auto faults = [&](const std::string& name, std::string_view text) {
        return faults_of([&] { load_mesh(folder.write(name, text)); }, folder);
    };
    const std::string points =
        "holds a cloud of points and no faces, and scanners see faces only; make a mesh of it, as "
        "MeshLab and CloudCompare can";
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
        "property float z\n";
    const std::string rows = "end_header\n0 0 0\n1 0 0\n";
    EXPECT_THAT(faults("scan.ply", header + rows), ElementsAre("scan.ply: " + points));
    EXPECT_THAT(faults("scan.ply", header +
                                       "element face 0\nproperty list uchar int "
                                       "vertex_indices\n" +
                                       rows),
                ElementsAre("scan.ply: " + points));
    EXPECT_THAT(faults("scan.obj", "v 0 0 0\nv 1 1 1\n"), ElementsAre("scan.obj: " + points));
    EXPECT_THAT(faults("wire.obj", "v 0 0 0\nv 1 1 1\nl 1 2\n"),
                ElementsAre("wire.obj: holds lines and no faces, and scanners see faces only; make "
                            "a mesh of it, as MeshLab and CloudCompare can"));
}

TEST(MeshFile, refusesVerticesThatAreNotFinite) {
    const TempDir folder;
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const auto file = folder.write("a.stl", binary_stl(bad));
        EXPECT_THAT(faults_of([&] { load_mesh(file); }, folder),
                    ElementsAre("a.stl: has a vertex that is not finite"));
    }
    const auto file = folder.write("b.stl", binary_stl(1e30F));
    const glm::dvec3 scale{1.0, 1.0, 1e30};
    EXPECT_THAT(
        faults_of([&] { load_mesh(file, scale); }, folder),
        ElementsAre(
            "b.stl: has a vertex that is not finite, or more than 1e7 m from its origin; is "
            "it in metres, and its scale right?"));
}

}  // namespace
}  // namespace scipd::sim
