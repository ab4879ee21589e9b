// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What SDF, glTF and MTL say of transparency, metal and roughness arrives in the scene.
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/mesh/mesh_relief.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/mesh/mesh_text.h"
#include "tests/sim/loaders/sdf/sdf_text.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using ::testing::HasSubstr;

constexpr double float_error = 1e-6;

class Appearances : public ::testing::Test {
  protected:
    /// The materials of a world, by name.
    std::map<std::string, Material> materials_in(const std::filesystem::path& file) {
        const LoadedScene loaded = load_scene(file);
        std::map<std::string, Material> materials;
        for (const Object& object : loaded.scene->objects) {
            const Material& material = loaded.scene->materials.at(object.material);
            materials[material.name] = material;
        }
        return materials;
    }

    /// A solid of oak and steel, of which `oak` and `steel` say more.
    std::filesystem::path gltf(const std::string& oak, const std::string& steel,
                               const std::string& more = {}) {
        std::string text = gltf_text(corners_);
        const auto say = [&](const std::string& name, const std::string& said) {
            const std::string plain = "{\"name\":\"" + name + "\"";
            text.replace(text.find(plain), plain.size(), plain + said);
        };
        say("oak", oak);
        say("steel", steel);
        return dir_.write("a.gltf", "{" + more + text.substr(1));
    }

    std::filesystem::path obj(const std::string& mtl) {
        dir_.write("a.mtl", mtl);
        return dir_.write("a.obj", obj_text(corners_, "a.mtl"));
    }

    static void expect_near(const std::optional<double>& is, const std::optional<double>& was,
                            const char* what) {
        constexpr double unsaid = -1.0;
        EXPECT_NEAR(is.value_or(unsaid), was.value_or(unsaid), float_error) << what;
    }
    static void expect(const Material& material, const Appearance& appearance) {
        expect_near(material.appearance.transparency, appearance.transparency, "transparency");
        expect_near(material.appearance.metalness, appearance.metalness, "metalness");
        expect_near(material.appearance.roughness, appearance.roughness, "roughness");
    }

    tests::TempDir dir_;
    const Corners corners_ = corners_of(Solid{}, glm::mat3{1.F});
};

TEST_F(Appearances, ComeFromGltf) {
    const auto file =
        gltf(R"(,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25],)"
             R"("metallicFactor":0,"roughnessFactor":0.3})",
             R"(,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25],"metallicFactor":0.8,)"
             R"("roughnessFactor":0.4})");
    auto materials = materials_in(file);
    expect(materials.at("oak"), {.transparency = 0.75});
    expect(materials.at("steel"), {.metalness = 0.8, .roughness = 0.4});
}

TEST_F(Appearances, AreNothingWhereAGltfSaysNothing) {
    for (const auto& [name, material] : materials_in(gltf("", R"(,"pbrMetallicRoughness":{})")))
        EXPECT_EQ(material.appearance, Appearance{}) << name;
}

// The file has a fault in what no scanner sees, so that only its reduced form is read.
TEST_F(Appearances, ComeFromTheReducedFormOfAGltf) {
    const auto file =
        gltf(R"(,"pbrMetallicRoughness":{"metallicFactor":0.8,"roughnessFactor":0.4})", "",
             R"("cameras":[{"type":3}],"animations":{"a":1},)");
    expect(materials_in(file).at("oak"), {.metalness = 0.8, .roughness = 0.4});
    EXPECT_THAT(relieved_gltf(R"({"materials":[{"name":"a","normalTexture":{},"alphaMode":"BLEND",)"
                              R"("pbrMetallicRoughness":{"baseColorTexture":{},)"
                              R"("roughnessFactor":0.5}}]})"),
                HasSubstr(R"("materials":[{"alphaMode":"BLEND","name":"a",)"
                          R"("pbrMetallicRoughness":{"roughnessFactor":0.5}}])"));
}

TEST_F(Appearances, ComeFromMtl) {
    auto materials = materials_in(obj("newmtl oak\nd 0.4\nnewmtl steel\nPm 0.9\nPr 0.2\n"));
    expect(materials.at("oak"), {.transparency = 0.6});
    expect(materials.at("steel"), {.metalness = 0.9, .roughness = 0.2});
    materials = materials_in(obj("newmtl oak\nTr 0.4\nnewmtl steel\nd 1\n"));
    expect(materials.at("oak"), {.transparency = 0.4});
    EXPECT_EQ(materials.at("steel").appearance, Appearance{});
}

TEST_F(Appearances, ComeFromSdf) {
    const std::string metal =
        "<material><pbr><metal><metalness>0.7</metalness><roughness>0.2</roughness></metal></pbr>"
        "</material>";
    const auto name = [](const std::string& text) {
        return "<scipd:material>" + text + "</scipd:material>";
    };
    const auto file = dir_.write(
        "w.sdf",
        world(model_of(visual("a", unit_box, name("pane") + "<transparency>0.8</transparency>") +
                       visual("b", unit_box, name("sheet") + metal) +
                       visual("c", unit_box,
                              name("plain") + "<transparency>0</transparency>"
                                              "<material><pbr><metal/></pbr></material>"))));
    const auto materials = materials_in(file);
    expect(materials.at("pane"), {.transparency = 0.8});
    expect(materials.at("sheet"), {.metalness = 0.7, .roughness = 0.2});
    EXPECT_EQ(materials.at("plain").appearance, Appearance{});
}

TEST_F(Appearances, OfAVisualComeBeforeThoseOfItsMesh) {
    obj("newmtl oak\nd 0.4\nnewmtl steel\nPm 0.9\nPr 0.2\n");
    const auto file = dir_.write(
        "w.sdf",
        world(model_of(visual("a", mesh_of("a.obj"), "<transparency>0.8</transparency>"))));
    auto materials = materials_in(file);
    expect(materials.at("oak"), {.transparency = 0.8});
    expect(materials.at("steel"), {.transparency = 0.8, .metalness = 0.9, .roughness = 0.2});

    dir_.write(
        "w.sdf",
        world(model_of(visual("a", mesh_of("a.obj"), "<scipd:material>tin</scipd:material>"))));
    materials = materials_in(file);
    ASSERT_EQ(materials.size(), 1U);
    EXPECT_EQ(materials.at("tin").appearance, Appearance{});
}

TEST_F(Appearances, MakeOtherMaterialsOfOneName) {
    const auto file = dir_.write(
        "w.sdf", world(model_of(visual("a", unit_box, "<transparency>0.8</transparency>") +
                                visual("b", unit_box, "<transparency>0.2</transparency>") +
                                visual("c", unit_box, "<transparency>0.8</transparency>") +
                                visual("d", unit_box))));
    const LoadedScene loaded = load_scene(file);
    const auto& objects = loaded.scene->objects;
    EXPECT_EQ(loaded.scene->materials.size(), 3U);
    EXPECT_EQ(objects[0].material, objects[2].material);
    EXPECT_NE(objects[0].material, objects[1].material);
    EXPECT_EQ(objects[3].material, 0U);
}

}  // namespace
}  // namespace scipd::sim
