// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world goes out as SDF and comes in again by the readers of all worlds, which know nothing of
// the writer: what it is made of, where all of it is, and what a beam meets.
#include "sim/export/sdf_text.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <sstream>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

std::string obj_of(const Mesh& mesh) {
    std::ostringstream text;
    text.precision(9);
    for (const glm::vec3& v : mesh.vertices_m)
        text << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const glm::uvec3& t : mesh.triangles)
        text << "f " << t.x + 1 << ' ' << t.y + 1 << ' ' << t.z + 1 << '\n';
    return text.str();
}

/// The models are at these poses.
LoadedScene out_and_in(const Scene& scene, const std::vector<Pose>& poses) {
    const tests::TempDir folder;
    const auto uri = [&](ObjectId id) {
        const std::string name = "mesh_" + std::to_string(id) + ".obj";
        folder.write(name, obj_of(*std::get<SharedMesh>(scene.objects[id].shape)));
        return name;
    };
    return load_scene(folder.write("world.sdf", sdf_of(scene, poses, uri)));
}

std::vector<Pose> poses_of(const Scene& scene) {
    std::vector<Pose> poses;
    for (const Model& model : scene.models)
        poses.push_back(model.world_from_model);
    return poses;
}

using Named = std::tuple<std::string, bool>;

std::vector<Named> models_of(const Scene& scene) {
    std::vector<Named> models;
    for (const Model& model : scene.models)
        models.emplace_back(model.name, model.movable);
    return models;
}

using Made = std::tuple<std::string, std::string, std::optional<double>, std::size_t>;

/// Each object's model, material and kind of shape.
std::vector<Made> objects_of(const Scene& scene) {
    std::vector<Made> objects;
    for (const Object& object : scene.objects) {
        const Material& material = scene.materials[object.material];
        objects.emplace_back(scene.models[object.model].name, material.name, material.laser_retro,
                             object.shape.index());
    }
    return objects;
}

/// Ranges to all sides, from inside the world's bounds.
std::vector<float> ranges_in(const SharedScene& scene, const glm::dvec3& eye_m) {
    const auto backend = make_backend("embree", scene);
    const Pose pose{eye_m};
    std::vector<float> ranges;
    for (int i = 0; i < 1440; ++i) {
        const double angle_rad = std::numbers::pi * i / 720.0;
        const double up = 0.2 * std::sin(7.0 * angle_rad);
        const glm::vec3 along =
            glm::normalize(glm::dvec3{std::cos(angle_rad), std::sin(angle_rad), up});
        Hit hit;
        backend->cast({.directions = {&along, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
        ranges.push_back(hit.range_m);
    }
    return ranges;
}

void expect_same(const SharedScene& before, const SharedScene& after, const glm::dvec3& eye_m) {
    const auto a = ranges_in(before, eye_m);
    const auto b = ranges_in(after, eye_m);
    int hits = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::isinf(a[i]) && std::isinf(b[i])) continue;
        ++hits;
        ASSERT_NEAR(a[i], b[i], 1e-4F) << i;
    }
    EXPECT_GT(hits, 100);
}

class SdfText : public ::testing::TestWithParam<const char*> {};

TEST_P(SdfText, ComesBackAsItWas) {
    const fs::path scenes = fs::path{SCIPD_SOURCES} / "scenes";
    const auto scene =
        load_scene(scenes / GetParam(), {.sdf = {.model_folders = {scenes / "models"}}}).scene;
    const auto again = out_and_in(*scene, poses_of(*scene)).scene;
    EXPECT_THAT(models_of(*again), ::testing::UnorderedElementsAreArray(models_of(*scene)));
    EXPECT_THAT(objects_of(*again), ::testing::UnorderedElementsAreArray(objects_of(*scene)));
    expect_same(scene, again, scene->anchor_m + glm::dvec3{0.3, 0.2, 0.3});
}

INSTANTIATE_TEST_SUITE_P(Scenes, SdfText,
                         ::testing::Values("square_room.sdf", "depot.sdf", "materials.sdf",
                                           "rescue_maze.sdf", "office_map.yaml", "crossing.sdf"));

TEST(SdfText, HasModelsWhereTheyAreNow) {
    Scene scene;
    scene.models = {{"shelf", false, {{1.0, 2.0, 0.0}}},
                    {"shelf::box & lid", true, {{1.0, 2.0, 1.0}}}};
    const Pose moved = pose_from_rpy({3.0, -1.0, 0.5}, {0.1, -0.2, 2.0});
    scene.objects = {{"shelf::l::board", 0, {{0.0, 0.0, 0.5}}, Box{{2.0, 1.0, 0.1}}},
                     {"shelf::box & lid::l::side", 1, {}, Sphere{0.25}},
                     {"shelf::box & lid::l::side", 1, {{0.5, 0.0, 0.0}}, Cylinder{0.1, 0.4}}};
    const auto again = out_and_in(scene, {scene.models[0].world_from_model, moved}).scene;
    EXPECT_EQ(models_of(*again), models_of(scene));
    ASSERT_EQ(again->objects.size(), 3U);
    const auto box = find_model(*again, "shelf::box & lid");
    ASSERT_TRUE(box);
    const Pose& there = again->models[*box].world_from_model;
    EXPECT_LT(glm::length(there.translation_m - moved.translation_m), 1e-9);
    EXPECT_LT(angle_between_rad(there.rotation, moved.rotation), 1e-7);
}

TEST(SdfText, SaysWhatTheWorldSaidOfAMaterial) {
    Scene scene;
    scene.models = {{"m", false, {}}};
    const std::vector<Material> all{{"default"},
                                    {"tape", 900.0},
                                    {"pane", std::nullopt, {.transparency = 0.4}},
                                    {"steel", 0.5, {.metalness = 0.9, .roughness = 0.2}},
                                    {"Gazebo/Wood", std::nullopt, {}, true}};
    scene.materials = all;
    for (MaterialId id = 0; id < all.size(); ++id)
        scene.objects.push_back({"m::l::v", 0, {{2.0 * id, 0.0, 0.0}}, Box{{1, 1, 1}}, id});
    const auto again = out_and_in(scene, poses_of(scene)).scene;
    ASSERT_EQ(again->objects.size(), all.size());
    for (const Object& object : again->objects) {
        const auto id =
            static_cast<MaterialId>(std::lround(object.model_from_object.translation_m.x / 2.0));
        EXPECT_EQ(again->materials[object.material], all[id]) << all[id].name;
    }
}

}  // namespace
}  // namespace scipd::sim
