// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Places where no sensor can be meant to be, and places that look like them and are none.
#include "sim/backends/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/poses/trajectory_file.h"
#include "sim/loaders/scene_file.h"
#include "tests/support/scene_builder.h"

namespace scipd::sim {
namespace {

using Kind = OddPlace::Kind;

Pose at(double x_m, double y_m, double z_m) {
    return pose_from_rpy({x_m, y_m, z_m}, {0.0, 0.0, 0.0});
}

std::optional<OddPlace> odd(const SharedScene& scene, const glm::dvec3& at_m,
                            ModelId body = no_model) {
    std::vector<Pose> poses;
    for (const Model& model : scene->models)
        poses.push_back(model.world_from_model);
    return odd_place(*scene, poses, at_m, body);
}

void expect(Kind kind, ObjectId object, const std::optional<OddPlace>& place) {
    ASSERT_TRUE(place);
    EXPECT_EQ(place->kind, kind);
    EXPECT_EQ(place->object, object);
}

/// A cube of 2 m around its origin. `faces`: how many of its six, the one above last.
SharedMesh cube(bool outwards, unsigned first = 0, unsigned faces = 6) {
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.vertices_m.emplace_back(i & 1U ? 1 : -1, i & 2U ? 1 : -1, i & 4U ? 1 : -1);
    // Counter-clockwise as they are seen from outside.
    const std::array<std::array<unsigned, 4>, 6> all{
        {{0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}};
    for (unsigned i = first; i < first + faces; ++i) {
        const auto& [a, b, c, d] = all[i];
        for (const glm::uvec3 triangle : {glm::uvec3{a, b, c}, glm::uvec3{a, c, d}})
            mesh.triangles.push_back(outwards ? triangle
                                              : glm::uvec3{triangle.x, triangle.z, triangle.y});
    }
    return std::make_shared<const Mesh>(std::move(mesh));
}

TEST(Surroundings, InsideWhatIsRoundOrHasCorners) {
    const auto scene = SceneBuilder()
                           .add(Plane{{100, 100}}, {})
                           .add(Box{{2, 2, 2}}, pose_from_rpy({5, 0, 1}, {0, 0, 0.6}))
                           .add(Cylinder{0.5, 1}, at(0, 5, 0.5))
                           .add(Sphere{0.5}, at(0, -5, 0.5))
                           .build();
    expect(Kind::inside, 1, odd(scene, {5, 0, 0.3}));
    expect(Kind::inside, 1, odd(scene, {5, 1.2, 1}));  // in a corner of it, as it is turned
    expect(Kind::inside, 2, odd(scene, {0.3, 5.3, 0.3}));
    expect(Kind::inside, 3, odd(scene, {0.2, -5.2, 0.7}));
    EXPECT_FALSE(odd(scene, {6.2, 0.9, 1}));
    EXPECT_FALSE(odd(scene, {0.45, 5.45, 0.3}));
    EXPECT_FALSE(odd(scene, {0.4, -5.4, 0.8}));
    EXPECT_FALSE(odd(scene, {0, 0, 0})) << "on the ground itself";
    EXPECT_FALSE(odd(scene, {5, 0, 2})) << "on top of it";
}

TEST(Surroundings, InsideAMeshThatIsClosed) {
    const auto scene = [](const SharedMesh& mesh) {
        return SceneBuilder().add(mesh, pose_from_rpy({3, 2, 1}, {0.2, 0.3, 0.4})).build();
    };
    const glm::dvec3 within{3.3, 2.1, 1.2};
    expect(Kind::inside, 0, odd(scene(cube(true)), within));
    EXPECT_FALSE(odd(scene(cube(true)), {5, 5, 1}));
    EXPECT_FALSE(odd(scene(cube(false)), within)) << "a room, seen from inside";
    EXPECT_FALSE(odd(scene(cube(true, 0, 5)), within)) << "a box without its lid";
}

TEST(Surroundings, InsideAMeshOfTwoMaterials) {
    const auto scene = SceneBuilder()
                           .movable(at(3, 2, 1))
                           .with(cube(true, 0, 2), {})
                           .with(cube(true, 2, 4), {})
                           .build();
    expect(Kind::inside, 0, odd(scene, {3.3, 2.1, 1.2}));
    EXPECT_FALSE(odd(scene, {3.3, 2.1, 2.2}));
}

TEST(Surroundings, ABodyIsNothingToItsOwnSensors) {
    const auto scene = SceneBuilder().movable(at(1, 1, 0)).with(Box{{2, 2, 2}}, {}).build();
    expect(Kind::inside, 0, odd(scene, {1, 1, 0.2}));
    EXPECT_FALSE(odd(scene, {1, 1, 0.2}, 0));
    // It is where it is now, and not where it was loaded.
    const std::array poses{at(9, 9, 0)};
    EXPECT_FALSE(odd_place(*scene, poses, {1, 1, 0.2}));
    EXPECT_TRUE(odd_place(*scene, poses, {9, 9, 0.2}));
}

TEST(Surroundings, BelowTheGround) {
    const auto plane = SceneBuilder()
                           .add(Box{{0.2, 20, 2}}, at(4, 0, 0.5))  // a wall, sunk by half a metre
                           .add(Plane{{100, 100}}, {})
                           .build();
    expect(Kind::below, 1, odd(plane, {0, 0, -0.3}));
    EXPECT_FALSE(odd(plane, {0, 0, 0.3}));
    EXPECT_FALSE(odd(plane, {70, 0, -0.3})) << "beside it";

    const auto floor = SceneBuilder().add(Box{{20, 20, 0.1}}, at(0, 0, -0.05)).build();
    expect(Kind::below, 0, odd(floor, {1, 2, -0.5}));
    EXPECT_FALSE(odd(floor, {1, 2, 0.5}));
}

TEST(Surroundings, BelowWhatIsNoGround) {
    const auto roofed = SceneBuilder()
                            .add(Box{{20, 20, 0.1}}, at(0, 0, 3))
                            .add(Box{{0.1, 20, 3}}, at(10, 0, 1.5))
                            .build();
    EXPECT_FALSE(odd(roofed, {0, 0, 1})) << "no floor, but walls";
    const auto storeys =
        SceneBuilder().add(Plane{{20, 20}}, at(0, 0, 3)).add(Plane{{20, 20}}, {}).build();
    EXPECT_FALSE(odd(storeys, {0, 0, 1})) << "on a storey below another";
    const auto table = SceneBuilder().add(Box{{2, 1, 0.05}}, at(0, 0, 0.7)).build();
    EXPECT_FALSE(odd(table, {0, 0, 0.3}));
    const auto ceiling =
        SceneBuilder()
            .add(Plane{{20, 20}}, pose_from_rpy({0, 0, 3}, {std::numbers::pi, 0, 0}))
            .build();
    EXPECT_FALSE(odd(ceiling, {0, 0, 1})) << "a plane that is turned downwards";
}

std::filesystem::path scene_file(const std::string& name) {
    return std::filesystem::path{SCIPD_SCENES} / name;
}

TEST(Surroundings, AreNeverOddOnADriveThroughAScene) {
    for (const std::string name : {"rescue_maze", "square_room", "corridor"}) {
        const auto scene = load_scene(scene_file(name + ".sdf")).scene;
        const std::vector<TimedPose> drive = load_trajectory(scene_file(name + ".tum")).poses;
        ASSERT_FALSE(drive.empty());
        for (std::size_t i = 0; i < drive.size(); i += 20) {
            for (const double height_m : {0.1, 0.25, 0.6}) {
                const glm::dvec3 at_m = drive[i].pose.translation_m + glm::dvec3{0, 0, height_m};
                EXPECT_FALSE(odd(scene, at_m)) << name << ' ' << i << ' ' << height_m;
            }
        }
    }
}

/// Whether all rays of a ball meet something: the reference backend's word, which counts no faces.
bool enclosed(RangeBackend& backend, const glm::dvec3& at_m) {
    std::vector<glm::vec3> ball;
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double turn_rad = i * 2.399963;
        const double out = std::sqrt(1 - z * z);
        ball.emplace_back(out * std::cos(turn_rad), out * std::sin(turn_rad), z);
    }
    const Pose pose{at_m, {1, 0, 0, 0}};
    std::vector<Hit> hits(ball.size());
    backend.cast({.directions = ball, .world_from_sensor = {&pose, 1}}, hits);
    return std::ranges::all_of(hits, &Hit::met);
}

TEST(Surroundings, OfASceneAreOddOnlyWhereNothingIsSeenOfTheSky) {
    int inside = 0;
    for (const char* file :
         {"rescue_maze.sdf", "square_room.sdf", "corridor.sdf", "depot.sdf", "office_map.yaml"}) {
        const auto scene = load_scene(scene_file(file)).scene;
        const auto backend = make_backend("reference", scene);
        for (double x_m = -1.03; x_m < 15; x_m += 0.7) {
            for (double y_m = -1.07; y_m < 10; y_m += 0.9) {
                const glm::dvec3 at_m{x_m, y_m, 0.27};
                const auto place = odd(scene, at_m);
                if (!place) continue;
                EXPECT_EQ(place->kind, Kind::inside) << file << ' ' << x_m << ' ' << y_m;
                EXPECT_TRUE(enclosed(*backend, at_m)) << file << ' ' << x_m << ' ' << y_m;
                ++inside;
            }
        }
    }
    EXPECT_GT(inside, 3) << "walls and crates, some of which a grid has to meet";
}

/// A robot with a plate, a post and a lidar in a housing, whose links are joined rigidly.
class HousingOf : public testing::Test {
  protected:
    void add(const std::string& link, Shape shape, const Pose& model_from_object) {
        const std::string name = "agv::" + link + "::v" + std::to_string(scene_.objects.size());
        scene_.objects.push_back({name, 0, model_from_object, std::move(shape), 0});
    }
    [[nodiscard]] std::vector<ObjectId> housing(const std::string& link) const {
        return housing_of(scene_, 0, link, sensor_, directions_);
    }

    Scene scene_{.models = {{"agv", true, {}}}};
    Pose sensor_ = at(0.15, 0, 0.25);
    std::vector<glm::vec3> directions_ = [] {
        std::vector<glm::vec3> fan;
        for (int i = -135; i <= 135; ++i) {
            const double angle_rad = i * std::numbers::pi / 180;
            fan.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0);
        }
        return fan;
    }();
};

TEST_F(HousingOf, IsWhatEnclosesTheEmitterOnItsOwnLink) {
    add("base", Box{{0.5, 0.4, 0.1}}, at(0, 0, 0.1));
    add("base", Cylinder{0.02, 0.8}, at(0.05, 0.18, 0.4));
    EXPECT_TRUE(housing("agv::laser").empty());
    add("laser", Cylinder{0.03, 0.07}, at(0.15, 0, 0.24));
    add("laser", Box{{0.06, 0.06, 0.06}}, at(0.13, 0, 0.20));  // below
    add("laser", Box{{0.3, 0.3, 0.3}}, at(-0.01, 0, 0.25));    // behind
    EXPECT_EQ(housing("agv::laser"), std::vector<ObjectId>{2});
    EXPECT_TRUE(housing_of(scene_, no_model, "agv::laser", sensor_, directions_).empty());
}

TEST_F(HousingOf, MayBeAnOpenMeshInSeveralMaterials) {
    // A cube without its top and back, one material a pair of sides, 5 cm around the emitter.
    for (const unsigned first : {0U, 2U}) {
        Mesh mesh = *cube(true, first, 2);
        for (glm::vec3& vertex : mesh.vertices_m)
            vertex *= 0.05F;
        scene_.objects.push_back(
            {"agv::laser::v", 0, sensor_, std::make_shared<const Mesh>(std::move(mesh)), 0});
    }
    EXPECT_EQ(housing("agv::laser"), (std::vector<ObjectId>{0, 1}));
}

// The frame of a sensor is often a link of its own, with nothing on it.
TEST_F(HousingOf, OfALinkWithoutOneIsThatOfTheLinkAround) {
    add("shell", Cylinder{0.12, 0.2}, at(0.15, 0, 0.25));
    add("laser", Cylinder{0.03, 0.07}, at(0.15, 0, 0.24));
    EXPECT_EQ(housing("agv::laser_frame"), std::vector<ObjectId>{1});
    EXPECT_EQ(housing(""), std::vector<ObjectId>{1});
    EXPECT_EQ(housing("agv::shell"), std::vector<ObjectId>{0});
}

// A hull as wide as a robot is a mistake, which the user wants to see.
TEST_F(HousingOf, IsNoLargerThanAScanner) {
    add("laser", Sphere{0.5}, sensor_);
    EXPECT_TRUE(housing("agv::laser").empty());
    add("base", Sphere{0.2}, sensor_);
    EXPECT_TRUE(housing("agv::laser").empty());
}

}  // namespace
}  // namespace scipd::sim
