// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/scene_answer.h"

#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "sim/loaders/file/plain_file.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

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

File written(const Scene& scene) {
    File file = memory_file();
    put_scene(scene, file.get());
    std::rewind(file.get());
    return file;
}

std::string bytes_of(const Scene& scene) {
    const File file = written(scene);
    std::string bytes(100'000, ' ');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    return bytes;
}

Scene taken_from(const std::string& bytes) {
    const File file = memory_file();
    std::fwrite(bytes.data(), 1, bytes.size(), file.get());
    std::rewind(file.get());
    return take_scene(file.get());
}

TEST(SceneAnswer, ArrivesWhole) {
    const Scene sent = full_scene();
    const File file = written(sent);
    const auto arrived = std::make_shared<const Scene>(take_scene(file.get()));
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

void expect_no_answer(const Scene& scene) {
    EXPECT_THROW(taken_from(bytes_of(scene)), std::runtime_error);
}

// The reader may have lost its senses over a file.
TEST(SceneAnswer, ThatLeadsNowhereIsNone) {
    Scene scene = full_scene();
    scene.objects[0].model = 2;
    expect_no_answer(scene);
    scene = full_scene();
    scene.objects[0].material = 3;
    expect_no_answer(scene);
    scene = full_scene();
    scene.frames[0].model = no_model;
    expect_no_answer(scene);
    scene = full_scene();
    scene.models[1].script = std::make_shared<const Script>();
    expect_no_answer(scene);
    scene = full_scene();
    scene.objects[4].shape = std::make_shared<const Mesh>(Mesh{{{0, 0, 0}}, {{0, 0, 1}}});
    expect_no_answer(scene);
    scene = full_scene();
    scene.materials.clear();
    expect_no_answer(scene);
}

TEST(SceneAnswer, ThatEndsEarlyIsNone) {
    const std::string whole = bytes_of(full_scene());
    ASSERT_NO_THROW(taken_from(whole));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW(taken_from(whole.substr(0, size)), std::runtime_error) << size;
}

// A sanitizer would see what goes wrong, and a size that is believed would take all memory.
TEST(SceneAnswer, OfAnyBytesIsASceneOrNone) {
    const std::string whole = bytes_of(full_scene());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char byte : {'\x00', '\x01', '\x7F', '\xFF'}) {
            std::string damaged = whole;
            damaged[at] = byte;
            try {
                for (const Object& object : taken_from(damaged).objects)
                    (void)object.shape.index();
            } catch (const std::runtime_error&) {
            }
        }
    }
}

}  // namespace
}  // namespace scipd::sim
