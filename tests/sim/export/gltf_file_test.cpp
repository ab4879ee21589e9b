// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world goes out and comes in again by Assimp, which knows nothing of the writer.
#include "sim/export/gltf_file.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

Scene some_world() {
    Scene scene;
    scene.materials = {{"default"}, {"wood"}};
    scene.models.push_back({"m", false, pose_from_rpy({1.0, 2.0, 0.0}, {0.0, 0.0, 0.7})});
    const auto wedge =
        std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}});
    const auto add = [&](const char* name, const Shape& shape, const Pose& pose,
                         MaterialId material) {
        scene.objects.push_back({name, 0, pose, shape, material});
    };
    add("m::l::box", Box{{1.0, 2.0, 0.5}}, {{3.0, 0.0, 0.25}}, 0);
    add("m::l::wedge", wedge, pose_from_rpy({-3.0, 0.0, 0.0}, {0.1, 0.2, 0.3}), 1);
    add("m::l::again", wedge, {{0.0, 3.0, 0.0}}, 1);
    add("m::l::ball", Sphere{0.8}, {{0.0, -4.0, 0.5}}, 0);
    return scene;
}

TEST(GltfFile, ComesBackWhereItWas) {
    const tests::TempDir folder;
    const auto scene = std::make_shared<const Scene>(some_world());
    const auto file = folder.write("w.glb", glb_of(placed_meshes(*scene), "hall", {}));
    const auto loaded = load_scene(file);
    EXPECT_THAT(loaded.warnings, ::testing::Each(::testing::HasSubstr("material")));
    const auto before = make_backend("reference", scene);
    const auto after = make_backend("reference", loaded.scene);
    const Pose pose{{1.0, 2.0, 0.2}};
    int hits = 0;
    for (int i = 0; i < 720; ++i) {
        const double angle_rad = std::numbers::pi * i / 360.0;
        const glm::vec3 along{std::cos(angle_rad), std::sin(angle_rad), 0.0};
        Hit a;
        Hit b;
        before->cast({.directions = {&along, 1}, .world_from_sensor = {&pose, 1}}, {&a, 1});
        after->cast({.directions = {&along, 1}, .world_from_sensor = {&pose, 1}}, {&b, 1});
        ASSERT_EQ(std::isinf(a.range_m), std::isinf(b.range_m)) << i;
        if (std::isinf(a.range_m)) continue;
        ++hits;
        EXPECT_NEAR(a.range_m, b.range_m, 1e-2) << i;
    }
    EXPECT_GT(hits, 100);
}

TEST(GltfFile, KeepsNamesAndSharesMeshes) {
    const std::string bytes = glb_of(placed_meshes(some_world()), "hall", {{"wood", {0.4, 0.25}}});
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 8, 4);
    EXPECT_EQ(length, bytes.size());
    std::uint32_t json_length = 0;
    std::memcpy(&json_length, bytes.data() + 12, 4);
    EXPECT_EQ(json_length % 4, 0U);
    const auto document = nlohmann::json::parse(bytes.substr(20, json_length));
    const auto& nodes = document.at("nodes");
    ASSERT_EQ(nodes.size(), 5U);
    EXPECT_EQ(nodes[0].at("name"), "hall");
    EXPECT_EQ(nodes[2].at("name"), "m::l::wedge");
    EXPECT_EQ(nodes[2].at("mesh"), nodes[3].at("mesh"));
    EXPECT_EQ(document.at("meshes").size(), 3U);
    const auto& wood = document.at("materials").at(1);
    EXPECT_EQ(wood.at("name"), "wood");
    EXPECT_EQ(wood.at("pbrMetallicRoughness").at("baseColorFactor"),
              (std::vector{0.4, 0.4, 0.4, 0.75}));
    EXPECT_EQ(wood.at("alphaMode"), "BLEND");
}

}  // namespace
}  // namespace scipd::sim
