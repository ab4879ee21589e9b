// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The worlds of scenes/ are what their comments and the README say, and the drives through them hit
// nothing.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/poses/trajectory_file.h"
#include "sim/loaders/scene_file.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/world/script.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::IsEmpty;

std::filesystem::path scene_file(const std::string& name) {
    return std::filesystem::path{SCIPD_SCENES} / name;
}

/// Horizontal ranges all around, every degree from -180 on, from a scanner 0.3 m above a robot.
std::vector<float> sweep_m(RangeBackend& backend, const Pose& world_from_robot) {
    std::vector<glm::vec3> directions;
    for (int degree = -180; degree < 180; ++degree) {
        const float angle_rad = static_cast<float>(degree) * std::numbers::pi_v<float> / 180.F;
        directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.F);
    }
    const Pose world_from_sensor = world_from_robot * Pose{{0.0, 0.0, 0.3}, {1.0, 0.0, 0.0, 0.0}};
    std::vector<Hit> hits(directions.size());
    backend.cast({.directions = directions, .world_from_sensor = {&world_from_sensor, 1}}, hits);
    std::vector<float> ranges_m(hits.size());
    std::transform(hits.begin(), hits.end(), ranges_m.begin(),
                   [](const Hit& hit) { return hit.range_m; });
    return ranges_m;
}

float nearest_m(RangeBackend& backend, const Pose& world_from_robot) {
    return std::ranges::min(sweep_m(backend, world_from_robot));
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const auto& object : scene.objects)
        count += tessellate(object.shape).triangles.size();
    return count;
}

class Worlds : public ::testing::TestWithParam<const char*> {
  protected:
    std::string name_ = GetParam();
    LoadedScene loaded_ = load_sdf(scene_file(name_ + ".sdf"));
};

TEST_P(Worlds, loadWithoutAWarning) {
    EXPECT_THAT(loaded_.warnings, IsEmpty());
    EXPECT_EQ(loaded_.scene->name, name_);
    EXPECT_THAT(loaded_.scene->models, Contains(Field(&Model::movable, true)));
}

TEST_P(Worlds, nameAMaterialForEverySurface) {
    for (const auto& object : loaded_.scene->objects)
        EXPECT_NE(object.material, 0U) << object.name;
}

TEST_P(Worlds, areClosedToAScannerInside) {
    auto backend = make_backend("reference", loaded_.scene);
    const auto drive = load_trajectory(scene_file(name_ + ".tum")).poses;
    for (const auto& end : {drive.front(), drive.back()}) {
        EXPECT_TRUE(std::isfinite(std::ranges::max(sweep_m(*backend, end.pose))));
    }
}

TEST_P(Worlds, leaveTheirDriveFree) {
    auto backend = make_backend("reference", loaded_.scene);
    const auto drive = load_trajectory(scene_file(name_ + ".tum")).poses;
    for (std::size_t i = 0; i < drive.size(); i += 5) {
        ASSERT_GT(nearest_m(*backend, drive[i].pose), 0.3F) << "pose " << i;
    }
}

TEST_P(Worlds, areDrivenThroughAtASteadyRate) {
    const auto drive = load_trajectory(scene_file(name_ + ".tum")).poses;
    EXPECT_EQ(drive.front().time, Time{0});
    for (std::size_t i = 1; i < drive.size(); ++i) {
        const auto step = drive[i].time - drive[i - 1].time;
        EXPECT_GE(step, std::chrono::milliseconds{20});
        EXPECT_LE(step, std::chrono::milliseconds{50});
        EXPECT_LT(glm::length(drive[i].pose.translation_m - drive[i - 1].pose.translation_m), 0.06);
    }
    EXPECT_LT(std::filesystem::file_size(scene_file(name_ + ".tum")), 60'000U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Worlds,
                         ::testing::Values("rescue_maze", "square_room", "corridor"),
                         [](const auto& instance) { return std::string{instance.param}; });

TEST(RescueMaze, hasTheTrianglesThatPagesTell) {
    const auto scene = load_sdf(scene_file("rescue_maze.sdf")).scene;
    const std::size_t count = triangle_count(*scene);
    for (const char* page : {"scenes/README.md", "docs/performance.md"}) {
        std::ifstream file{scene_file("..") / page};
        const std::string text{std::istreambuf_iterator<char>{file}, {}};
        std::smatch told;
        ASSERT_TRUE(std::regex_search(text, told, std::regex{"(\\d) (\\d00) triangles"})) << page;
        EXPECT_NEAR(double(count), 1000 * std::stoi(told[1]) + std::stoi(told[2]), 50) << page;
    }
    EXPECT_GE(scene->materials.size(), 6U);
}

TEST(RescueMaze, leavesTheStartFree) {
    auto backend = make_backend("reference", load_sdf(scene_file("rescue_maze.sdf")).scene);
    const float nearest = nearest_m(*backend, {{1.0, 1.0, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    EXPECT_GT(nearest, 0.99F);
    // The outer walls, whose inner faces are the axes.
    EXPECT_NEAR(nearest, 1.0F, 1e-4F);
}

TEST(Crossing, hasTheRangesThatItsCommentLists) {
    const auto [scene, warnings] = load_sdf(scene_file("crossing.sdf"));
    EXPECT_THAT(warnings, IsEmpty());
    const ModelId person = find_model(*scene, "person").value();
    const Script& walk = *scene->models[person].script;
    EXPECT_EQ(walk.lap, std::chrono::seconds(6));
    auto backend = make_backend("reference", scene);
    for (const auto& [time_ms, range_m] :
         {std::pair{0, 3.F}, {1200, 1.33F}, {4200, 1.33F}, {6000, 3.F}, {7200, 1.33F}}) {
        backend->move(person, walk.at(Time{}, std::chrono::milliseconds(time_ms)));
        EXPECT_NEAR(sweep_m(*backend, Pose{}).at(180), range_m, 1e-4F) << time_ms;
    }
    for (Time time{}; time < walk.lap; time += std::chrono::milliseconds(20)) {
        backend->move(person, walk.at(Time{}, time));
        ASSERT_GT(nearest_m(*backend, Pose{}), 1.2F) << "no robot at the origin is run over";
    }
}

TEST(SquareRoom, hasTheRangesThatItsCommentLists) {
    auto backend = make_backend("reference", load_sdf(scene_file("square_room.sdf")).scene);
    const auto range_m = sweep_m(*backend, Pose{});
    const auto at = [&](int degree) { return range_m.at(static_cast<std::size_t>(degree + 180)); };
    const float root_2 = std::numbers::sqrt2_v<float>;
    EXPECT_NEAR(at(0), 3.F, 1e-4F);
    EXPECT_NEAR(at(90), 2.F, 1e-4F);
    EXPECT_NEAR(at(-90), 2.F, 1e-4F);
    EXPECT_NEAR(at(-180), 3.F, 1e-4F);
    EXPECT_NEAR(at(45), 1.5F * root_2 - 0.25F, 1e-4F);
    EXPECT_NEAR(at(-45), 1.5F * root_2, 1e-4F);
    EXPECT_NEAR(at(135), 2.F * root_2, 1e-4F);
    EXPECT_NEAR(at(-135), 2.F * root_2, 1e-4F);
    // Between them, where only one wall can be seen.
    for (int degree = -15; degree <= 15; ++degree) {
        const float angle_rad = static_cast<float>(degree) * std::numbers::pi_v<float> / 180.F;
        EXPECT_NEAR(at(degree), 3.F / std::cos(angle_rad), 1e-4F) << degree;
    }
}

TEST(Corridor, isTwoMetresWideBetweenItsDoors) {
    auto backend = make_backend("reference", load_sdf(scene_file("corridor.sdf")).scene);
    const auto range_m = sweep_m(*backend, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    EXPECT_NEAR(range_m[0], 1.F, 1e-4F);
    EXPECT_NEAR(range_m[90], 1.F, 1e-4F);
    EXPECT_NEAR(range_m[180], 29.F, 1e-3F);
    EXPECT_NEAR(range_m[270], 1.F, 1e-4F);
}

/// What a scanner 0.5 m above the origin sees in this direction.
Hit seen_in_depot(const LoadedScene& depot, int degree) {
    auto backend = make_backend("reference", depot.scene);
    const double angle_rad = degree * std::numbers::pi / 180.0;
    const glm::vec3 direction{std::cos(angle_rad), std::sin(angle_rad), 0.0};
    const Pose pose{{0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0}};
    Hit hit;
    backend->cast({.directions = {&direction, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
    return hit;
}

TEST(Depot, HasTheRangesThatItsCommentLists) {
    const auto depot = load_sdf(scene_file("depot.sdf"));
    EXPECT_THAT(depot.warnings, IsEmpty());
    const auto name_at = [&](int degree) {
        return depot.scene->objects.at(seen_in_depot(depot, degree).object).name;
    };
    EXPECT_NEAR(seen_in_depot(depot, 0).range_m, 12.F, 1e-4F);
    EXPECT_EQ(name_at(0), "depot::gate::leaf::leaf");
    EXPECT_NEAR(seen_in_depot(depot, 90).range_m, 4.65F, 1e-4F);
    EXPECT_EQ(name_at(90), "stored_1::carton::body::carton");
    EXPECT_NEAR(seen_in_depot(depot, -90).range_m, 8.F, 1e-4F);
    EXPECT_EQ(name_at(-90), "depot::hall::south");
    EXPECT_NEAR(seen_in_depot(depot, 180).range_m, 8.9F, 2e-4F);
    EXPECT_EQ(name_at(180), "bollard_0::post::post");
}

TEST(Depot, SaysWhatMoves) {
    const auto depot = load_sdf(scene_file("depot.sdf"));
    std::vector<std::string> movable;
    for (const auto& model : depot.scene->models) {
        if (model.movable) movable.push_back(model.name);
    }
    EXPECT_THAT(movable,
                ::testing::UnorderedElementsAre("depot::gate", "floor_0", "floor_1", "forklift"));
}

TEST(Depot, NamesAMaterialForEverySurfaceAndTheRetroOfSome) {
    const auto depot = load_sdf(scene_file("depot.sdf"));
    for (const auto& object : depot.scene->objects)
        EXPECT_NE(object.material, 0U) << object.name;
    EXPECT_THAT(depot.scene->materials, Contains(Material{"painted_steel", 15.0}));
    EXPECT_THAT(depot.scene->materials, Contains(Material{"steel", 40.0}));
    EXPECT_THAT(depot.scene->materials, Contains(Material{"rubber"}));
}

TEST(Depot, CanBeSeenByItsCollisions) {
    const auto depot = load_sdf(scene_file("depot.sdf"), {.geometry = SdfGeometry::collision});
    EXPECT_NEAR(seen_in_depot(depot, 0).range_m, 12.F, 1e-4F);
    EXPECT_NEAR(seen_in_depot(depot, 180).range_m, 8.9F, 1e-4F);
    // The bare wheels and the mast of the forklift, the ramp.
    for (const auto& warning : depot.warnings)
        EXPECT_THAT(warning, ::testing::HasSubstr("has visuals but no collision"));
}

TEST(OfficeMap, hasTheRangesThatItsCommentTells) {
    const auto loaded = load_scene(scene_file("office_map.yaml"));
    EXPECT_THAT(loaded.warnings, IsEmpty());
    auto backend = make_backend("reference", loaded.scene);
    const auto range_m = sweep_m(*backend, {{1.0, 4.5, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    EXPECT_NEAR(range_m[0], 1.F, 1e-5F);
    EXPECT_NEAR(range_m[90], 0.7F, 1e-5F);
    EXPECT_NEAR(range_m[180], 14.F, 1e-5F);
    EXPECT_NEAR(range_m[270], 0.7F, 1e-5F);
    EXPECT_TRUE(std::isfinite(std::ranges::max(range_m)));
    // At 45 degrees through a door to the table along the north wall, whose edge is at y 8.2.
    EXPECT_NEAR(range_m[225], 3.7F * std::numbers::sqrt2_v<float>, 1e-4F);
    EXPECT_LT(triangle_count(*loaded.scene), 1500U);
}

}  // namespace
}  // namespace scipd::sim
