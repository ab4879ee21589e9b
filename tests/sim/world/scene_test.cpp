// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scenes with a model more or less.
#include "sim/world/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;

Object object(const std::string& name, ModelId model, MaterialId material = 0) {
    return {name, model, Pose{}, Box{{1.0, 1.0, 1.0}}, material};
}

/// Three models; the second has a third inside that moves by itself.
Scene house() {
    Scene scene;
    scene.name = "house";
    scene.models = {{"wall"}, {"shed"}, {"shed::door", true}, {"shedding", true}};
    scene.materials = {{"default"}, {"oak"}, {"oak", 2.0}};
    scene.objects = {object("wall::l::v", 0), object("shed::l::v", 1, 1),
                     object("shed::door::l::v", 2, 2), object("shedding::l::v", 3, 1)};
    scene.anchor_m = {5.0, 6.0, 7.0};
    return scene;
}

Scene cart() {
    Scene scene;
    scene.models = {{"cart", true, {{1.0, 2.0, 3.0}, {1.0, 0.0, 0.0, 0.0}}}};
    scene.materials = {{"default"}, {"steel"}, {"oak", 2.0}, {"oak", 3.0}};
    scene.objects = {object("cart::a", 0, 2), object("cart::b", 0, 1), object("cart::c", 0, 3)};
    scene.anchor_m = {100.0, 0.0, 0.0};
    return scene;
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> all;
    for (const Model& model : scene.models)
        all.push_back(model.name);
    return all;
}

TEST(Scene, FindsModelsByTheirWholeName) {
    EXPECT_EQ(find_model(house(), "shed::door"), 2U);
    EXPECT_EQ(find_model(house(), "shed"), 1U);
    EXPECT_EQ(find_model(house(), "she"), std::nullopt);
    EXPECT_EQ(find_model(house(), ""), std::nullopt);
}

TEST(Scene, AModelMoreLeavesAllIdsAndTheAnchor) {
    const Scene before = house();
    const SharedScene after = with_models(before, cart());
    EXPECT_THAT(names(*after), ElementsAre("wall", "shed", "shed::door", "shedding", "cart"));
    EXPECT_EQ(after->anchor_m, before.anchor_m);
    EXPECT_EQ(after->name, "house");
    ASSERT_EQ(after->objects.size(), 7U);
    for (ObjectId id = 0; id < 4; ++id) {
        EXPECT_EQ(after->objects[id].name, before.objects[id].name);
        EXPECT_EQ(after->objects[id].model, before.objects[id].model);
        EXPECT_EQ(after->objects[id].material, before.objects[id].material);
    }
    for (ObjectId id = 4; id < 7; ++id)
        EXPECT_EQ(after->objects[id].model, 4U);
    EXPECT_EQ(after->models[4].world_from_model.translation_m, (glm::dvec3{1.0, 2.0, 3.0}));
    EXPECT_TRUE(after->models[4].movable);
}

TEST(Scene, MaterialsOfTheSameNameAndRetroAreOne) {
    const SharedScene after = with_models(house(), cart());
    EXPECT_THAT(after->materials,
                ElementsAre(Material{"default"}, Material{"oak"}, Material{"oak", 2.0},
                            Material{"steel"}, Material{"oak", 3.0}));
    EXPECT_EQ(after->objects[4].material, 2U);
    EXPECT_EQ(after->objects[5].material, 3U);
    EXPECT_EQ(after->objects[6].material, 4U);
}

TEST(Scene, MeshesAreShared) {
    Scene added = cart();
    const auto mesh = std::make_shared<const Mesh>();
    added.objects[0].shape = mesh;
    const SharedScene one = with_models(house(), added);
    const SharedScene two = without_model(*one, "wall");
    EXPECT_EQ(std::get<SharedMesh>(one->objects[4].shape), mesh);
    EXPECT_EQ(std::get<SharedMesh>(two->objects[3].shape), mesh);
}

TEST(Scene, AModelGoesWithAllThatLiesInIt) {
    const Scene before = house();
    const SharedScene after = without_model(before, "shed");
    ASSERT_NE(after, nullptr);
    // Not with what merely begins like it.
    EXPECT_THAT(names(*after), ElementsAre("wall", "shedding"));
    ASSERT_EQ(after->objects.size(), 2U);
    EXPECT_EQ(after->objects[0].model, 0U);
    EXPECT_EQ(after->objects[1].name, "shedding::l::v");
    EXPECT_EQ(after->objects[1].model, 1U);
    EXPECT_EQ(after->objects[1].material, 1U);
    EXPECT_EQ(after->materials, before.materials);
    EXPECT_EQ(after->anchor_m, before.anchor_m);
    EXPECT_EQ(before.models.size(), 4U);
}

TEST(Scene, FramesComeAndGoWithTheirModels) {
    Scene before = house();
    before.frames = {{"wall::l", 0, {}, {}, {}},
                     {"shed::l", 1, {}, {}, {}},
                     {"shed::door::l", 2, {}, {}, {}},
                     {"shedding::l", 3, {}, {}, {}}};
    Scene added = cart();
    added.frames = {{"cart::l::s", 0, {}, "ray", Lidar{.samples = 7}}};
    const SharedScene more = with_models(before, added);
    ASSERT_EQ(more->frames.size(), 5U);
    EXPECT_EQ(more->frames[4].model, 4U);
    EXPECT_EQ(more->frames[4].lidar, Lidar{.samples = 7});
    const SharedScene less = without_model(*more, "shed");
    ASSERT_EQ(less->frames.size(), 3U);
    EXPECT_EQ(less->frames[1].name, "shedding::l");
    EXPECT_EQ(less->frames[1].model, 1U);
    EXPECT_EQ(less->frames[2].name, "cart::l::s");
    EXPECT_EQ(less->frames[2].model, 2U);
}

TEST(Scene, WhatLiesInAModelGoesAlone) {
    EXPECT_THAT(names(*without_model(house(), "shed::door")),
                ElementsAre("wall", "shed", "shedding"));
}

TEST(Scene, ThereIsNoSceneWithoutAModelThatIsNotThere) {
    EXPECT_EQ(without_model(house(), "barn"), nullptr);
    EXPECT_EQ(without_model(house(), ""), nullptr);
}

TEST(Scene, ForgetsNamesThatNothingIsMadeOf) {
    Scene scene;
    scene.models = {{"hut"}};
    scene.materials = {{"default"}, {"unused"}, {"oak"}, {"shiny", 7.0}, {"elm"}, {"last"}};
    scene.objects = {object("hut::a", 0, 4), object("hut::b", 0, 2)};
    drop_unused_names(scene);
    EXPECT_THAT(scene.materials, ElementsAre(Material{"default"}, Material{"oak"},
                                             Material{"shiny", 7.0}, Material{"elm"}));
    EXPECT_EQ(scene.materials[scene.objects[0].material].name, "elm");
    EXPECT_EQ(scene.materials[scene.objects[1].material].name, "oak");
}

TEST(Scene, AddingAndRemovingIsNothing) {
    const SharedScene there_and_back = without_model(*with_models(house(), cart()), "cart");
    EXPECT_EQ(names(*there_and_back), names(house()));
    EXPECT_EQ(there_and_back->objects.size(), house().objects.size());
}

}  // namespace
}  // namespace scipd::sim
