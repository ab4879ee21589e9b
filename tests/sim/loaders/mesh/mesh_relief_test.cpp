// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults of mesh files that have nothing to do with where their triangles lie, and holes.
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/loaders/mesh/mesh_parts.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/map/map_folder.h"
#include "tests/sim/loaders/sdf/sdf_text.h"
#include "tests/support/sanitized.h"

namespace scipd::sim {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Named parts of a COLLADA; what is not changed is sound.
struct Dae {
    std::string libraries;
    std::string primitives =
        "<triangles count='1' material='q'>" + vertex + "<p>0 1 2</p></triangles>";
    std::string node = "<instance_geometry url='#g'/>";

    static inline const std::string vertex = "<input semantic='VERTEX' source='#v' offset='0'/>";

    /// A square of 2 m in x and y, and one of 1 m in its middle, both 3 m up.
    [[nodiscard]] std::string text() const {
        return "<?xml version='1.0'?><COLLADA "
               "xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
               "<asset><up_axis>Z_UP</up_axis></asset>" +
               libraries +
               "<library_geometries><geometry id='g' name='g'><mesh><source id='p'>"
               "<float_array id='pa' count='24'>0 0 3 2 0 3 2 2 3 0 2 3 0.5 0.5 3 1.5 0.5 3 1.5 "
               "1.5 3 0.5 1.5 3</float_array><technique_common><accessor source='#pa' count='8' "
               "stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
               "<param name='Z' type='float'/></accessor></technique_common></source>"
               "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>" +
               primitives +
               "</mesh></geometry></library_geometries><library_visual_scenes>"
               "<visual_scene id='s'><node id='n' name='n'><translate sid='t'>10 0 0</translate>" +
               node +
               "</node></visual_scene></library_visual_scenes>"
               "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
    }
};

std::string source(const std::string& id, const std::string& kind, const std::string& values,
                   int count, int stride) {
    return "<source id='" + id + "'><" + kind + " id='" + id + "a' count='" +
           std::to_string(count * stride) + "'>" + values + "</" + kind +
           "><technique_common><accessor source='#" + id + "a' count='" + std::to_string(count) +
           "' stride='" + std::to_string(stride) + "'><param name='" +
           (kind == "Name_array" ? "JOINT' type='name" : "TIME' type='float") +
           "'/></accessor></technique_common></source>";
}

Dae skinned(const std::string& inside) {
    return {.libraries = "<library_controllers><controller id='c'><skin source='#g'>" + inside +
                         "</skin></controller></library_controllers>",
            .node =
                "<instance_controller url='#c'><skeleton>#gone</skeleton>"
                "</instance_controller>"};
}

Dae weighted(const std::string& weights) {
    const std::string unit = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    return skinned(source("j", "Name_array", "bone", 1, 1) + source("w", "float_array", "1", 1, 1) +
                   source("b", "float_array", unit, 1, 16) +
                   "<joints><input semantic='JOINT' source='#j'/>"
                   "<input semantic='INV_BIND_MATRIX' source='#b'/></joints>"
                   "<vertex_weights count='8'><input semantic='JOINT' source='#j' offset='0'/>"
                   "<input semantic='WEIGHT' source='#w' offset='1'/>"
                   "<vcount>1 1 1 1 1 1 1 1</vcount><v>" +
                   weights + " 0 0 0 0 0 0 0 0 0 0 0 0 0 0</v></vertex_weights>");
}

Dae animated(const std::string& inside) {
    return {.libraries = "<library_animations><animation id='a'>" +
                         source("i", "float_array", "0 1", 2, 1) + inside +
                         "</animation></library_animations>"};
}

std::string corners_with(const std::string& input) {
    return "<triangles count='1'>" + Dae::vertex + input + "<p>0 0 1 0 2 0</p></triangles>";
}

/// 0 0 3, 2 0 3, 2 2 3 in floats, then 0 1 2 in words.
const std::string buffer_in_base64 = "AAAAAAAAAAAAAEBAAAAAQAAAAAAAAEBAAAAAQAAAAEAAAEBAAAABAAIAAAA=";

/// One triangle, 3 m up; `more` is put over what is there.
std::string gltf(const json& more) {
    json file = json::parse(R"({"asset": {"version": "2.0"},
        "buffers": [{"byteLength": 44}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 3], "max": [2, 2, 3]},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"name": "n", "mesh": 0, "translation": [10, 0, 0]}],
        "scenes": [{"nodes": [0]}], "scene": 0})");
    file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + buffer_in_base64;
    file.merge_patch(more);
    return file.dump();
}

std::string primitive(const std::string& more) {
    return R"({"meshes": [{"primitives": [{"indices": 1, )" + more + "}]}]}";
}

/// With `before` in the file and `more` in its node.
std::string node(const std::string& before, const std::string& more) {
    return "{" + before + R"("nodes": [{"name": "n", "mesh": 0, "translation": [10, 0, 0], )" +
           more + "}]}";
}

/// Its buffer behind it.
std::string glb(const std::string& text) {
    json file = json::parse(text);
    file["buffers"][0].erase("uri");
    std::string inside = file.dump();
    inside.resize((inside.size() + 3) / 4 * 4, ' ');
    const float up = 3.F;
    const float two = 2.F;
    std::string buffer(44, '\0');
    const auto put = [&](std::size_t at, const float& number) {
        std::memcpy(buffer.data() + 4 * at, &number, sizeof number);
    };
    for (const std::size_t at : {2U, 5U, 8U})
        put(at, up);
    for (const std::size_t at : {3U, 6U, 7U})
        put(at, two);
    buffer[38] = 1;
    buffer[40] = 2;
    const auto word = [](std::size_t number) {
        std::string bytes;
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(number >> shift & 255U);
        return bytes;
    };
    return "glTF" + word(2) + word(28 + inside.size() + buffer.size()) + word(inside.size()) +
           "JSON" + inside + word(buffer.size()) + std::string{"BIN\0", 4} + buffer;
}

struct Case {
    const char* title;
    const char* file;
    std::string text;
};

const std::string bad_skin = node(R"("skins": [{"joints": [7]}], )", R"("skin": 0)");

std::vector<Case> cases() {
    const auto with = [](const char* change) { return gltf(json::parse(change)); };
    return {
        {"skin_without_joints", "a.dae",
         skinned("<joints><input semantic='JOINT' source='#gone'/></joints>").text()},
        {"skin_without_anything", "a.dae", skinned("").text()},
        {"skin_of_a_joint_too_many", "a.dae", weighted("9 0").text()},
        {"skin_of_a_weight_too_many", "a.dae", weighted("0 7").text()},
        {"animation_without_values", "a.dae",
         animated("<sampler id='sa'><input semantic='INPUT' source='#i'/><input semantic='OUTPUT' "
                  "source='#gone'/></sampler><channel source='#sa' target='n/t'/>")
             .text()},
        {"animation_of_too_few_values", "a.dae",
         animated(source("o", "float_array", "0 1 2", 3, 1) +
                  "<sampler id='sa'><input semantic='INPUT' source='#i'/><input semantic='OUTPUT' "
                  "source='#o'/></sampler><channel source='#sa' target='n/t.X'/>")
             .text()},
        {"normals_that_are_not_there", "a.dae",
         Dae{.primitives = corners_with("<input semantic='NORMAL' source='#gone' offset='1'/>")}
             .text()},
        {"texture_coordinates_that_are_not_there", "a.dae",
         Dae{.primitives = corners_with("<input semantic='TEXCOORD' source='#gone' offset='1'/>")}
             .text()},
        {"a_wrong_count", "a.dae",
         Dae{.primitives = "<triangles count='7'>" + Dae::vertex + "<p>0 1 2</p></triangles>"}
             .text()},
        {"lights_and_cameras_that_are_not_there", "a.dae",
         Dae{.node = "<instance_geometry url='#g'/><instance_camera url='#gone'/>"
                     "<instance_light url='#gone'/>"}
             .text()},
        {"skin", "a.gltf", gltf(json::parse(bad_skin))},
        {"skin_in_glb", "a.glb", glb(gltf(json::parse(bad_skin)))},
        {"skin_without_bones", "a.gltf",
         gltf(json::parse(node(R"("skins": [{"joints": []}], )", R"("skin": 0)")))},
        {"animation", "a.gltf",
         with(R"({"animations": [{"channels": [{"sampler": 0, "target": {"node": 0,
              "path": "translation"}}], "samplers": [{"input": 9, "output": 9}]}]})")},
        {"camera", "a.gltf", with(R"({"cameras": [{}]})")},
        {"camera_that_is_not_there", "a.gltf", gltf(json::parse(node("", R"("camera": 3)")))},
        {"normals", "a.gltf",
         gltf(json::parse(primitive(R"("attributes": {"POSITION": 0, "NORMAL": 9})")))},
        {"weights", "a.gltf",
         gltf(json::parse(primitive(R"("attributes": {"POSITION": 0, "JOINTS_0": 0,
                                    "WEIGHTS_0": 0})")))},
        {"morph_target", "a.gltf",
         gltf(json::parse(
             primitive(R"("attributes": {"POSITION": 0}, "targets": [{"POSITION": 9}])")))},
        {"material_that_is_not_there", "a.gltf",
         gltf(json::parse(primitive(R"("attributes": {"POSITION": 0}, "material": 5)")))},
        {"picture", "a.gltf", with(R"({"images": [{}], "textures": [{"source": 0}]})")},
        {"texture_that_is_not_there", "a.gltf",
         with(R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 9}}}]})")},
        {"no_mtl", "a.obj", "mtllib gone.mtl\nv 10 0 3\nv 12 0 3\nv 12 2 3\nusemtl oak\nf 1 2 3\n"},
        {"an_mtl_of_no_numbers", "a.obj",
         "mtllib bad.mtl\nv 10 0 3\nv 12 0 3\nv 12 2 3\nusemtl oak\nf 1 2 3\n"},
    };
}

class MeshRelief : public ::testing::TestWithParam<Case> {
  protected:
    tests::TempDir folder_;
};

INSTANTIATE_TEST_SUITE_P(Of, MeshRelief, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string{one.param.title}; });

TEST_P(MeshRelief, TheTriangleIsWhereItIs) {
    // The second does so with ThreadSanitizer's allocator only, which leaves nothing behind an
    // array.
    const bool crashes_assimp = GetParam().title == std::string_view{"skin_without_bones"} ||
                                GetParam().title == std::string_view{"skin_of_a_joint_too_many"};
    if (tests::sanitized && crashes_assimp) GTEST_SKIP() << tests::sanitizers_report_crashes;
    folder_.write("bad.mtl", "newmtl oak\nKd a b c\nmap_Kd gone.png\n");
    const auto parts = load_mesh_parts(folder_.write(GetParam().file, GetParam().text));
    ASSERT_EQ(parts.size(), 1U);
    const Mesh& mesh = parts[0].mesh;
    ASSERT_EQ(mesh.triangles.size(), 1U);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 3; ++i)
        corners.push_back(mesh.vertices_m[mesh.triangles[0][i]]);
    EXPECT_THAT(corners, ::testing::UnorderedElementsAre(glm::vec3{10, 0, 3}, glm::vec3{12, 0, 3},
                                                         glm::vec3{12, 2, 3}));
}

class MeshHoles : public ::testing::Test {
  protected:
    /// Where a beam from above meets it: the square less its middle.
    void expect_a_hole(const std::string& primitives) {
        const auto file = folder_.write("a.dae", Dae{.primitives = primitives}.text());
        const auto loaded =
            load_sdf_text("<model name='m'><link name='l'>" + visual("v", mesh_of(file.string())) +
                              "</link></model>",
                          "t", folder_.path());
        EXPECT_THAT(loaded.warnings, ::testing::IsEmpty());
        Probe probe{loaded.scene};
        for (double x = 0.03; x < 2.0; x += 0.1) {
            for (double y = 0.04; y < 2.0; y += 0.1) {
                const bool in_hole = std::abs(x - 1.0) < 0.5 && std::abs(y - 1.0) < 0.5;
                EXPECT_NEAR(probe.top_m(10.0 + x, y), in_hole ? -1.F : 3.F, 1e-4) << x << ' ' << y;
            }
        }
    }

    tests::TempDir folder_;
};

TEST_F(MeshHoles, InPolygons) {
    expect_a_hole("<polygons count='1'>" + Dae::vertex +
                  "<ph><p>0 1 2 3</p><h>4 7 6 5</h></ph></polygons>");
}

TEST_F(MeshHoles, TurnEitherWay) {
    expect_a_hole("<polygons count='1'>" + Dae::vertex +
                  "<ph><p>3 2 1 0</p><h>4 7 6 5</h></ph></polygons>");
}

TEST_F(MeshHoles, AsSomeWriteThem) {
    expect_a_hole("<polygons count='1'>" + Dae::vertex + "<p>0 1 2 3</p><h>4 7 6 5</h></polygons>");
}

TEST_F(MeshHoles, OfCornersWithNormals) {
    expect_a_hole("<polygons count='1'>" + Dae::vertex +
                  "<input semantic='NORMAL' source='#p' offset='1'/>"
                  "<ph><p>0 0 1 0 2 0 3 0</p><h>4 0 7 0 6 0 5 0</h></ph></polygons>");
}

TEST_F(MeshHoles, BesidePolygonsWithout) {
    expect_a_hole("<polygons count='2' material='q'>" + Dae::vertex +
                  "<p>0 1 5 4</p><ph><p>0 1 2 3</p><h>4 7 6 5</h></ph></polygons>");
}

TEST_F(MeshHoles, OfCornersThatAreNotThere) {
    const auto file = folder_.write(
        "a.dae", Dae{.primitives = "<polygons count='1'>" + Dae::vertex +
                                   "<ph><p>0 1 2 3</p><h>4 7 66 5</h></ph></polygons>"}
                     .text());
    EXPECT_THAT(faults_of([&] { load_mesh_parts(file); }, folder_),
                ElementsAre("a.dae: has a polygon whose corners are not there"));
}

// Without what undoes it, its numbers would be taken for positions.
TEST(MeshReliefOfGltf, KeepsOffWhatIsCompressed) {
    const tests::TempDir folder;
    const auto file =
        folder.write("a.gltf", gltf(json::parse(node(
                                   R"("extensionsRequired": ["KHR_draco_mesh_compression"],
                            "skins": [{"joints": [7]}], )",
                                   R"("skin": 0)"))));
    EXPECT_THAT(faults_of([&] { load_mesh_parts(file); }, folder),
                ElementsAre(HasSubstr("a.gltf: is compressed")));
}

}  // namespace
}  // namespace scipd::sim
