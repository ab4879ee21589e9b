// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/confined_scene.h"

#include <csignal>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// One of everything that a scene can hold.
Scene full_scene() {
    const auto mesh = std::make_shared<const Mesh>(
        Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25F}}, {{0, 1, 2}, {2, 1, 0}}});
    const auto other = std::make_shared<const Mesh>(Mesh{{{5, 0, 0}}, {}});
    Scene scene;
    scene.name = "w";
    const Pose start = pose_from_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
    const Script script{{{Time(0), start}, {Time(5), Pose{}}}, Time(9)};
    scene.models = {{"a", false, {}},
                    {"b::c", true, start, std::make_shared<const Script>(script)}};
    scene.materials = {{"default"}, {"oak", 7.5}, {"", std::nullopt, {0.25, 0.5, 1.0}}};
    const Pose pose = pose_from_rpy({4, 5, 6}, {0.4, 0.5, 0.6});
    scene.objects = {{"a::box", 0, {}, Box{{1, 2, 3}}, 0}, {"a::can", 0, pose, Cylinder{0.5, 2}, 1},
                     {"b::ball", 1, {}, Sphere{0.25}, 2},  {"b::floor", 1, {}, Plane{{10, 20}}, 0},
                     {"b::mesh", 1, {}, mesh, 1},          {"b::other", 1, {}, other, 1},
                     {"b::again", 1, pose, mesh, 2}};
    scene.frames = {{"a::l", 0, pose, {}, {}},
                    {"b::c::l::s", 1, {}, "gpu_lidar", Lidar{360, 16, -1, 2, 0.1, 30, 5.5}}};
    scene.anchor_m = {100, -200, 3};
    return scene;
}

LoadedScene through_a_child(const Scene& scene, std::vector<std::string> warnings) {
    return load_confined("x", {}, [&] {
        return LoadedScene{std::make_shared<const Scene>(scene), warnings};
    });
}

std::vector<std::string> faults_of_child(const std::function<void()>& work,
                                         const LoadLimits& limits = {}) {
    try {
        load_confined("x", limits, [&] {
            work();
            return LoadedScene{};
        });
    } catch (const LoadError& error) {
        return error.faults();
    }
    return {};
}

TEST(ConfinedScene, ArrivesWhole) {
    const Scene sent = full_scene();
    const auto [arrived, warnings] = through_a_child(sent, {"one", "", "three\nlines"});
    EXPECT_THAT(warnings, ElementsAre("one", "", "three\nlines"));
    EXPECT_EQ(arrived->name, sent.name);
    EXPECT_EQ(arrived->anchor_m, sent.anchor_m);
    EXPECT_EQ(arrived->materials, sent.materials);
    ASSERT_EQ(arrived->models.size(), 2U);
    EXPECT_EQ(arrived->models[1].name, "b::c");
    EXPECT_FALSE(arrived->models[0].movable);
    EXPECT_TRUE(arrived->models[1].movable);
    EXPECT_EQ(arrived->models[1].world_from_model, sent.models[1].world_from_model);
    EXPECT_EQ(arrived->models[0].script, nullptr);
    ASSERT_NE(arrived->models[1].script, nullptr);
    EXPECT_EQ(*arrived->models[1].script, *sent.models[1].script);
    ASSERT_EQ(arrived->objects.size(), sent.objects.size());
    for (std::size_t i = 0; i < sent.objects.size(); ++i) {
        const Object& is = arrived->objects[i];
        const Object& was = sent.objects[i];
        EXPECT_EQ(is.name, was.name);
        EXPECT_EQ(is.model, was.model);
        EXPECT_EQ(is.model_from_object, was.model_from_object);
        EXPECT_EQ(is.material, was.material);
        EXPECT_EQ(is.shape.index(), was.shape.index());
        EXPECT_EQ(tessellate(is.shape).vertices_m, tessellate(was.shape).vertices_m);
        EXPECT_EQ(tessellate(is.shape).triangles, tessellate(was.shape).triangles);
    }
    ASSERT_EQ(arrived->frames.size(), 2U);
    for (std::size_t i = 0; i < sent.frames.size(); ++i) {
        const Frame& is = arrived->frames[i];
        const Frame& was = sent.frames[i];
        EXPECT_EQ(is.name, was.name);
        EXPECT_EQ(is.model, was.model);
        EXPECT_EQ(is.model_from_frame, was.model_from_frame);
        EXPECT_EQ(is.sensor, was.sensor);
        EXPECT_EQ(is.lidar, was.lidar);
    }
    // What was shared is.
    EXPECT_EQ(std::get<SharedMesh>(arrived->objects[4].shape),
              std::get<SharedMesh>(arrived->objects[6].shape));
}

TEST(ConfinedScene, FaultsArriveEach) {
    EXPECT_THAT(faults_of_child([] {
                    throw LoadError({"a.sdf:1: one", "a.sdf:2: two\nlines"});
                }),
                ElementsAre("a.sdf:1: one", "a.sdf:2: two\nlines"));
    EXPECT_THAT(faults_of_child([] { throw std::logic_error("slip"); }), ElementsAre("x: slip"));
}

// The whole of a world may take so long, and the file that took it is one of many.
TEST(ConfinedScene, WhatTakesTooLongTellsWhatItWasAtAndTheLimit) {
    const auto wait_at = [](const std::string& what) {
        return faults_of_child(
            [&what] {
                now_doing("reading other.dae");
                now_doing(what);
                while (true)
                    pause();
            },
            {.wall_time = std::chrono::seconds{1}});
    };
    EXPECT_THAT(wait_at("reading a.dae"),
                ElementsAre("x: was not read within 1 s; at last it was reading a.dae; "
                            "world_load_s under limits in the configuration allows more"));
    EXPECT_THAT(wait_at(std::string(10'000, 'a')), ElementsAre(HasSubstr("it was aaa")));
}

TEST(ConfinedScene, WhatCrashesOrNeverEndsIsAFault) {
    EXPECT_THAT(faults_of_child([] {
                    std::signal(SIGABRT, SIG_DFL);
                    std::raise(SIGABRT);
                }),
                ElementsAre(HasSubstr("x: crashes the library that reads it (signal 6)")));
    EXPECT_THAT(faults_of_child([] { pause(); }, {.wall_time = std::chrono::seconds{1}}),
                ElementsAre(HasSubstr("x: was not read within 1 s")));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(faults_of_child([] { pause(); }, {.stop = stop.get_token()}),
                ElementsAre("x: was not read to its end"));
}

}  // namespace
}  // namespace scipd::sim
