// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Models that a running scene is given: from a text, a file and a mesh.
#include "sim/loaders/model/model_fragment.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"
#include "tests/support/sanitized.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ModelFragment : public ::testing::Test {
  protected:
    LoadedScene load(const std::string& text, const Placement& placement) {
        return load_model_text(text, placement, folder_.path());
    }
    std::vector<std::string> faults(const std::string& text, const Placement& placement) {
        return faults_of([&] { load(text, placement); }, folder_);
    }

    TempDir folder_;
    const std::string box_ = "<model name='box'><pose>1 2 3 0 0 0</pose><link name='l'>" +
                             visual("v", unit_box) + "</link></model>";
};

float range_ahead_m(const SharedScene& scene) {
    auto backend = make_backend("reference", scene);
    const glm::vec3 ahead{1.F, 0.F, 0.F};
    const Pose here;
    Hit hit;
    backend->cast({.directions = {&ahead, 1}, .world_from_sensor = {&here, 1}}, {&hit, 1});
    return hit.range_m;
}

TEST_F(ModelFragment, HasTheNameAndThePoseThatItIsGiven) {
    const auto loaded = load(box_, {"crate", Pose{{7, 0, 0}, {1, 0, 0, 0}}});
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(loaded.scene->models.size(), 1U);
    EXPECT_EQ(loaded.scene->models[0].name, "crate");
    EXPECT_TRUE(loaded.scene->models[0].movable);
    EXPECT_EQ(loaded.scene->models[0].world_from_model.translation_m, (glm::dvec3{7, 0, 0}));
    EXPECT_EQ(loaded.scene->objects.at(0).name, "crate::l::v");
    EXPECT_FLOAT_EQ(range_ahead_m(loaded.scene), 6.5F);
}

TEST_F(ModelFragment, KeepsItsOwnPoseWhereNoneIsGiven) {
    const auto scene = load(box_, {"crate"}).scene;
    EXPECT_EQ(scene->models.at(0).world_from_model.translation_m, (glm::dvec3{1, 2, 3}));
}

TEST_F(ModelFragment, JoinsAndLeavesARunningScene) {
    const auto base = load_sdf(folder_.write(
        "w.sdf", world("<model name='wall'><static>true</static><pose>10 0 0 0 0 0</pose>"
                       "<link name='l'>" +
                       visual("v", unit_box) + "</link></model>")));
    EXPECT_FLOAT_EQ(range_ahead_m(base.scene), 9.5F);
    const auto added = load(box_, {"crate", Pose{{4, 0, 0}, {1, 0, 0, 0}}});
    const auto both = with_models(*base.scene, *added.scene);
    EXPECT_FLOAT_EQ(range_ahead_m(both), 3.5F);
    EXPECT_FLOAT_EQ(range_ahead_m(without_model(*both, "wall")), 3.5F);
    EXPECT_FLOAT_EQ(range_ahead_m(without_model(*both, "crate")), 9.5F);
}

TEST_F(ModelFragment, WhatMovesInsideGoesAlong) {
    const auto scene =
        load("<model name='hall'><static>true</static><link name='l'>" + visual("v", unit_box) +
                 "</link><model name='door'><static>false</static><pose>2 0 0 0 0 0</pose>"
                 "<link name='l'>" +
                 visual("v", unit_box) + "</link></model></model>",
             {"gym", pose_from_rpy({10, 0, 0}, {0, 0, 1.5707963267948966})})
            .scene;
    ASSERT_EQ(scene->models.size(), 2U);
    EXPECT_FALSE(scene->models[0].movable);
    EXPECT_EQ(scene->models[1].name, "gym::door");
    EXPECT_NEAR(scene->models[1].world_from_model.translation_m.x, 10.0, 1e-9);
    EXPECT_NEAR(scene->models[1].world_from_model.translation_m.y, 2.0, 1e-9);
    EXPECT_EQ(scene->objects.at(1).name, "gym::door::l::v");
}

const std::string hall_with_door =
    "<model name='hall'><static>true</static><link name='l'>" + visual("v", unit_box) +
    "</link><model name='door'><static>false</static><pose>0 4 0 0 0 0</pose><link name='l'>" +
    visual("v", unit_box) + "</link></model></model>";

TEST_F(ModelFragment, MovesAsOneBodyWhereItIsToldSo) {
    const Pose there = pose_from_rpy({0, -4, 0}, {0, 0, 0});
    const auto scene = load(hall_with_door, {"hall", there, true}).scene;
    ASSERT_EQ(scene->models.size(), 1U);
    EXPECT_TRUE(scene->models[0].movable);
    // Its door stands 4 m beside it, wherever it goes.
    auto backend = make_backend("reference", scene);
    const glm::vec3 ahead{1.F, 0.F, 0.F};
    const Pose here{{-3, 0, 0}, {1, 0, 0, 0}};
    Hit hit;
    const auto range_m = [&] {
        backend->cast({.directions = {&ahead, 1}, .world_from_sensor = {&here, 1}}, {&hit, 1});
        return hit.range_m;
    };
    EXPECT_FLOAT_EQ(range_m(), 2.5F);
    EXPECT_EQ(scene->objects.at(hit.object).name, "hall::door::l::v");
    backend->move(0, pose_from_rpy({4, 0, 0}, {0, 0, -1.5707963267948966}));
    EXPECT_FLOAT_EQ(range_m(), 6.5F);
    EXPECT_EQ(scene->objects.at(hit.object).name, "hall::l::v");
    const auto link = std::ranges::find(scene->frames, "hall::door::l", &Frame::name);
    ASSERT_NE(link, scene->frames.end());
    EXPECT_EQ(link->model, 0U);
    EXPECT_EQ(link->model_from_frame.translation_m, (glm::dvec3{0, 4, 0}));
}

TEST_F(ModelFragment, StandsStillWithAllThatLiesInItWhereItIsToldSo) {
    const auto hall = load(hall_with_door, {"hall", std::nullopt, false}).scene;
    ASSERT_EQ(hall->models.size(), 2U);
    EXPECT_FALSE(hall->models[0].movable);
    EXPECT_FALSE(hall->models[1].movable);
    EXPECT_FALSE(load(box_, {"box", std::nullopt, false}).scene->models.at(0).movable);
    const auto mesh =
        load_mesh_model(folder_.write("part.obj", triangle_obj), {"part", std::nullopt, false});
    EXPECT_FALSE(mesh.scene->models.at(0).movable);
}

TEST_F(ModelFragment, MayBeTheFolderOfAModel) {
    folder_.write("shelf/model.config",
                  "<model><name>shelf</name><sdf version='1.4'>old.sdf</sdf>"
                  "<sdf version='1.9'>model.sdf</sdf></model>");
    folder_.write("shelf/meshes/part.obj", triangle_obj);
    folder_.write("other/part.obj", triangle_obj);
    folder_.write("shelf/model.sdf",
                  "<sdf version='1.9'><model name='s'><static>true</static><link name='l'>" +
                      visual("own", "<mesh><uri>meshes/part.obj</uri></mesh>") +
                      visual("by_name", "<mesh><uri>model://shelf/meshes/part.obj</uri></mesh>") +
                      visual("beside", "<mesh><uri>model://other/part.obj</uri></mesh>") +
                      "</link></model></sdf>");
    const auto shelf = load_model({.placement = {"mine"}, .file = folder_.path() / "shelf"});
    EXPECT_THAT(shelf.warnings, IsEmpty());
    EXPECT_EQ(shelf.scene->models.at(0).name, "mine");
    EXPECT_FALSE(shelf.scene->models.at(0).movable);
    EXPECT_EQ(shelf.scene->objects.size(), 3U);
    // As a world it is the same.
    EXPECT_EQ(load_scene(folder_.path() / "shelf").scene->objects.size(), 3U);
    EXPECT_THAT(faults_of([&] { load_scene(folder_.path() / "other"); }, folder_),
                ElementsAre(AllOf(HasSubstr("other"), HasSubstr("model.config"))));
}

TEST_F(ModelFragment, IsNoEmptyWorld) {
    EXPECT_THAT(faults("<sdf version='1.9'><world name='w'/></sdf>", {"a"}),
                ElementsAre(HasSubstr("holds no model")));
}

TEST_F(ModelFragment, MayBeARobotOrAFile) {
    const auto urdf =
        "<robot name='r'><link name='l'><visual><geometry><box size='1 1 1'/>"
        "</geometry></visual></link></robot>";
    EXPECT_EQ(load(urdf, {"a"}).scene->models.at(0).name, "a");
    const auto file = folder_.write("robot.urdf", urdf);
    EXPECT_EQ(load_model({.placement = {"b"}, .file = file}).scene->models.at(0).name, "b");
}

TEST_F(ModelFragment, OfAMeshHasItsMaterialsOrOneOfItsOwn) {
    const auto file = folder_.write("part.obj", triangle_obj);
    const auto own = load_mesh_model(file, {"part"});
    EXPECT_EQ(own.scene->materials.at(own.scene->objects.at(0).material).name, "oak");
    const auto wood =
        load_mesh_model(file, {"part", Pose{{0, 0, 5}, {1, 0, 0, 0}}}, 2.0, "wood").scene;
    EXPECT_EQ(wood->materials.at(wood->objects.at(0).material).name, "wood");
    EXPECT_EQ(wood->objects.at(0).name, "part::part");
    EXPECT_TRUE(wood->models.at(0).movable);
    const auto& mesh = *std::get<SharedMesh>(wood->objects.at(0).shape);
    float widest = 0.F;
    for (const auto& vertex : mesh.vertices_m)
        widest = std::max(widest, vertex.x);
    EXPECT_FLOAT_EQ(widest, 2.F);
}

TEST_F(ModelFragment, RefusesWhatIsNoModel) {
    EXPECT_THAT(faults(box_, {""}), ElementsAre("name: is empty; give the model one"));
    EXPECT_THAT(
        faults(box_, {"a::b"}),
        ElementsAre("name: 'a::b': must not hold '::', which separates a model from its parts"));
    EXPECT_THAT(faults(world(box_ + "<model name='other'><link name='l'/></model>"), {"a"}),
                ElementsAre("a: holds several models; one is wanted here"));
    EXPECT_THAT(faults("", {"a"}), ElementsAre("a:1: is no XML that can be read: it is empty"));
    EXPECT_THAT(faults("<model name='m'/>", {"a"}),
                ElementsAre("a: holds no <world>, and no <model> with a <link>"));
    const auto file = folder_.write("part.obj", triangle_obj);
    EXPECT_THAT(faults_of([&] { load_mesh_model(file, {"a"}, 0.0); }, folder_),
                ElementsAre("scale: must be above 0 and at most 1e7"));
    EXPECT_THAT(faults_of([&] { load_mesh_model(folder_.path() / "b.obj", {"a"}); }, folder_),
                ElementsAre("b.obj: no such file; a mesh is wanted here"));
}

// A text lies in no file: what it names is looked for where the caller says, and there alone.
TEST_F(ModelFragment, SaysWhereItLooked) {
    EXPECT_THAT(faults("<model name='m'><link name='l'>" + visual("v", mesh_of("gone.obj")) +
                           "</link></model>",
                       {"crate"}),
                Contains("crate:1: m::l::v: there is no 'gone.obj' near " +
                         folder_.path().string() + "; left out"));
}

// A part of what a world may take.
TEST_F(ModelFragment, TakesNoMoreThanAModelsShare) {
    const SdfOptions share = within_a_models_share({.geometry = SdfGeometry::collision});
    EXPECT_EQ(share.geometry, SdfGeometry::collision);
    const auto refused = [&](const std::string& text) {
        return faults_of([&] { load_model_text(text, {"a"}, folder_.path(), share); }, folder_);
    };
    std::string links;
    for (int i = 0; i < 3000; ++i)
        links += "<link name='" + std::to_string(i) + "'/>";
    folder_.write("links.sdf", sdf("<model name='l'>" + links + "</model>"));
    std::string many;
    for (int i = 0; i < 200; ++i)
        many += "<include><uri>links.sdf</uri><name>" + std::to_string(i) + "</name></include>";
    EXPECT_THAT(refused("<model name='m'>" + many + "</model>"),
                ElementsAre("a: takes more than the 537 MB that are allowed, with all its "
                            "includes; put parts that never move into one link or one mesh, or "
                            "allow more by world_memory_mb under limits in the configuration"));

    const auto large = folder_.write("large.sdf", "");
    std::filesystem::resize_file(large, (8U << 20U) + 1);  // sparse: it takes no room
    EXPECT_THAT(refused("<model name='m'><include><uri>large.sdf</uri></include></model>"),
                ElementsAre("a:1: large.sdf: is larger than 8 MiB; left out",
                            "a: its model 'm' has no <link>, and none of its includes could be "
                            "read"));

    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    const auto mesh = folder_.write("huge.stl", "");
    std::filesystem::resize_file(mesh, 900U << 20U);
    EXPECT_THAT(
        faults_of([&] { load_mesh_model(mesh, {"a"}, 1.0, {}, share.mesh); }, folder_),
        ElementsAre("huge.stl: takes more than 536 MB of memory; world_memory_mb under limits in "
                    "the configuration allows more"));
    EXPECT_THAT(refused("<model name='m'><link name='l'><collision name='c'><geometry><mesh><uri>"
                        "huge.stl</uri></mesh></geometry></collision></link></model>"),
                Contains(HasSubstr("huge.stl: ")));
}

}  // namespace
}  // namespace scipd::sim
