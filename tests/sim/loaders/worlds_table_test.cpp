// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What docs/worlds.md says of what a world may hold, row by row: worlds/README.md names a world for
// each, and all backends see the same in it. Some are read a second time, by a reader that shares
// nothing with the loaders.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/plain/plain_world.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Row {
    std::string what;
    std::string becomes;
    std::string told;  ///< empty where nothing is
    std::string file;
};

void PrintTo(const Row& row, std::ostream* out) {
    *out << row.file << ": " << row.what;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::size_t begin = line.find('|');
    for (auto end = line.find('|', begin + 1); end != line.npos; end = line.find('|', begin + 1)) {
        const std::string cell = line.substr(begin + 1, end - begin - 1);
        const auto first = cell.find_first_not_of(' ');
        cells.push_back(
            first == cell.npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
        begin = end;
    }
    return cells;
}

std::vector<std::vector<std::string>> table_rows(const fs::path& file, std::size_t columns) {
    std::vector<std::vector<std::string>> rows;
    std::ifstream page{fs::path{SCIPD_SOURCES} / file};
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("| ")) continue;
        auto cells = cells_of(line);
        if (cells.size() == columns) rows.push_back(std::move(cells));
    }
    return rows;
}

const std::set<std::string> outcomes{
    "read", "read, with a warning", "ignored", "ignored, with a warning", "left out", "refused"};

/// What becomes of what a world has, as docs/worlds.md says it.
std::map<std::string, std::string> documented() {
    std::map<std::string, std::string> becomes;
    for (const auto& cells : table_rows("docs/worlds.md", 2))
        if (outcomes.contains(cells[1])) becomes[cells[0]] = cells[1];
    return becomes;
}

/// Every row of the table beside the worlds, once for each of its worlds.
std::vector<Row> rows() {
    std::vector<Row> rows;
    auto becomes = documented();
    for (const auto& cells : table_rows("tests/sim/loaders/worlds/README.md", 3)) {
        if (cells[0] == "row") continue;
        std::string told = cells[1];
        std::erase(told, '`');
        std::istringstream files{cells[2]};
        for (std::string file; files >> file;) {
            if (file.ends_with(',')) file.pop_back();
            rows.push_back({cells[0], becomes[cells[0]], told, file});
        }
    }
    return rows;
}

fs::path world_file(const std::string& name) {
    return fs::path{SCIPD_SOURCES} / "tests/sim/loaders/worlds" / name;
}

SceneOptions options(bool strict) {
    return {
        .sdf = {.model_folders = {fs::path{SCIPD_SOURCES} / "scenes/models"}, .strict = strict}};
}

constexpr std::size_t beams = 720;

/// All around, each a little up or down.
std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> all;
    for (std::size_t i = 0; i < beams; ++i) {
        const double angle_rad = glm::radians(0.5 * double(i) + 0.13);
        const double up_rad = 0.1 * std::sin(7.0 * angle_rad);
        all.emplace_back(std::cos(angle_rad) * std::cos(up_rad),
                         std::sin(angle_rad) * std::cos(up_rad), std::sin(up_rad));
    }
    return all;
}

constexpr glm::dvec3 above_the_origin_m{0.0, 0.0, 0.5};

std::vector<Hit> hits_of(const std::string& backend, const SharedScene& scene,
                         const glm::dvec3& from_m = above_the_origin_m) {
    const auto fan = directions();
    const Pose world_from_sensor{from_m, Pose{}.rotation};
    std::vector<Hit> hits(fan.size());
    make_backend(backend, scene)
        ->cast({.directions = fan, .world_from_sensor = {&world_from_sensor, 1}}, hits);
    return hits;
}

bool can_be_had(const std::string& backend) {
    try {
        make_backend(backend, std::make_shared<const Scene>());
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

/// A beam that touches a silhouette may take either side, and one that is flat has more error.
void expect_agreement(const std::vector<Hit>& hits, const std::vector<Hit>& truth) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < beams; ++i) {
        if (hits[i].object != truth[i].object) {
            ++differ;
        } else if (truth[i].met() && truth[i].cos_incidence > 0.2F) {
            EXPECT_NEAR(hits[i].range_m, truth[i].range_m, 5e-4) << "beam " << i;
        }
    }
    EXPECT_LE(differ, beams / 100);
}

class WorldsTable : public ::testing::TestWithParam<Row> {
  protected:
    std::vector<std::string> faults(bool strict) const {
        try {
            load_scene(world_file(GetParam().file), options(strict));
        } catch (const LoadError& error) {
            return error.faults();
        }
        return {};
    }
};

class SeenWorlds : public WorldsTable {};

std::vector<Row> rows_that_load() {
    auto all = rows();
    std::erase_if(all, [](const Row& row) { return row.becomes == "refused"; });
    return all;
}

std::string test_name_of(std::string file) {
    std::ranges::replace_if(
        file, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return file;
}

std::string test_name(const ::testing::TestParamInfo<Row>& test) {
    return test_name_of(test.param.file);
}

INSTANTIATE_TEST_SUITE_P(All, WorldsTable, ::testing::ValuesIn(rows()), test_name);
INSTANTIATE_TEST_SUITE_P(All, SeenWorlds, ::testing::ValuesIn(rows_that_load()), test_name);

TEST_P(WorldsTable, isTrue) {
    const auto& [what, becomes, told, file] = GetParam();
    ASSERT_TRUE(outcomes.contains(becomes)) << "docs/worlds.md has no row: " << what;
    if (becomes == "refused") {
        EXPECT_THAT(faults(false), Contains(HasSubstr(told)));
        return;
    }
    const auto loaded = load_scene(world_file(file), options(false));
    EXPECT_EQ(!told.empty(), becomes == "left out" || becomes.ends_with("with a warning"));
    if (told.empty()) {
        EXPECT_THAT(loaded.warnings, IsEmpty());
        if (becomes == "read") {
            EXPECT_THAT(faults(true), IsEmpty());
        }
    } else {
        EXPECT_THAT(loaded.warnings, Contains(HasSubstr(told)).Times(1));
        EXPECT_THAT(faults(true), Not(IsEmpty()));
    }
}

TEST_P(SeenWorlds, lookTheSameToAllBackends) {
    const auto scene = load_scene(world_file(GetParam().file), options(false)).scene;
    const auto truth = hits_of("reference", scene);
    EXPECT_EQ(std::ranges::any_of(truth, &Hit::met), !scene->objects.empty());
    for (const char* backend : {"embree", "depth"}) {
        SCOPED_TRACE(backend);
        if (can_be_had(backend)) expect_agreement(hits_of(backend, scene), truth);
    }
}

TEST(WorldsTable, hasAWorldForEveryRow) {
    std::set<std::string> tried;
    for (const Row& row : rows())
        tried.insert(row.what);
    ASSERT_GT(documented().size(), 80u);
    for (const auto& [what, becomes] : documented())
        EXPECT_THAT(tried, Contains(what));
}

TEST(WorldsTable, hasARowForEveryWorld) {
    std::set<std::string> named;
    for (const Row& row : rows())
        named.insert(row.file);
    const std::set<std::string> worlds{".sdf", ".urdf", ".world", ".yaml", ".xml", ".dae", ".gltf"};
    for (const auto& entry : fs::directory_iterator{world_file("")}) {
        if (!worlds.contains(entry.path().extension())) continue;
        EXPECT_THAT(named, Contains(entry.path().filename().string()));
    }
}

struct Twice {
    const char* file;
    glm::dvec3 from_m = above_the_origin_m;
};

void PrintTo(const Twice& twice, std::ostream* out) {
    *out << twice.file;
}

class SecondReader : public ::testing::TestWithParam<Twice> {};

INSTANTIATE_TEST_SUITE_P(All, SecondReader,
                         ::testing::Values(Twice{"scenes/square_room.sdf"},
                                           Twice{"scenes/corridor.sdf", {1.2, 0.1, 0.5}},
                                           Twice{"scenes/rescue_maze.sdf", {1.0, 1.0, 0.6}},
                                           Twice{"tests/sim/loaders/worlds/shapes.sdf"},
                                           Twice{"tests/sim/loaders/worlds/mesh.sdf"},
                                           Twice{"tests/sim/loaders/worlds/nested.sdf"},
                                           Twice{"tests/sim/loaders/worlds/include.sdf"},
                                           Twice{"tests/sim/loaders/worlds/model_alone.sdf"},
                                           Twice{"tests/sim/loaders/worlds/robot.urdf"},
                                           Twice{"tests/sim/loaders/worlds/version_1_12.sdf"},
                                           Twice{"tests/sim/loaders/worlds/colons_in_names.sdf"},
                                           Twice{"tests/sim/loaders/worlds/inertia.sdf"},
                                           Twice{"tests/sim/loaders/worlds/no_version.sdf"},
                                           Twice{"tests/sim/loaders/worlds/robot_with_lidar.urdf"},
                                           Twice{"tests/sim/loaders/worlds/robot_of_one_body.urdf"},
                                           Twice{
                                               "tests/sim/loaders/worlds/sensors_and_joints.sdf"}));

TEST_P(SecondReader, seesTheSame) {
    const fs::path file = fs::path{SCIPD_SOURCES} / GetParam().file;
    const glm::dvec3 from_m = GetParam().from_m;
    const auto world = tests::read_plain_world(file);
    const auto scene = load_scene(file, options(false)).scene;
    const auto hits = hits_of("reference", scene, from_m);
    const auto fan = directions();
    std::size_t met = 0;
    for (std::size_t i = 0; i < beams; ++i) {
        const auto range_m =
            tests::plain_range_m(world, from_m, glm::normalize(glm::dvec3{fan[i]}));
        ASSERT_EQ(range_m.has_value(), hits[i].met()) << "beam " << i;
        if (!range_m) continue;
        ++met;
        EXPECT_NEAR(*range_m, hits[i].range_m, 1e-5 * (1.0 + *range_m)) << "beam " << i;
    }
    EXPECT_GT(met, beams / 20);
}

/// Worlds that differ in what is nothing to a scanner, or left out.
using Alike = std::vector<const char*>;

class WorldsAlike : public ::testing::TestWithParam<Alike> {};

INSTANTIATE_TEST_SUITE_P(
    All, WorldsAlike,
    ::testing::Values(
        Alike{"no_version.sdf", "version_of_words.sdf", "lidar.sdf", "lidar_of_nothing.sdf",
              "mesh_without_uri.sdf", "short_road.sdf", "heightmap_missing.sdf",
              "missing_submesh.sdf"},
        Alike{"heightmap.sdf", "heightmap_textures.sdf", "heightmap_coloured.sdf"},
        Alike{"actor.sdf", "actor_stands.sdf", "actor_goes_back.sdf", "actor_animation.sdf",
              "actor_no_waypoints.sdf", "actor_lost_waypoint.sdf"},
        Alike{"missing_mtl.obj", "faulty_mtl.obj", "faulty_animation.dae", "faulty_skin.dae",
              "faulty.gltf"},
        Alike{"map_pgm.yaml", "map_png.yaml", "map_bmp.yaml", "map_jpg.yaml", "map_mode.yaml",
              "mvsim_grid.xml"},
        Alike{"stage_missing_bitmap.world", "stage_missing_include.world", "stage_unknown.world"},
        Alike{"mvsim_comments.xml", "mvsim_dem.xml", "mvsim_empty_grid.xml"},
        Alike{"mvsim_gui.xml", "mvsim_vehicle.xml", "mvsim_shown_block.xml"}),
    [](const auto& test) { return test_name_of(test.param.front()); });

TEST_P(WorldsAlike, lookTheSame) {
    const auto truth =
        hits_of("reference", load_scene(world_file(GetParam().front()), options(false)).scene);
    for (const char* file : GetParam()) {
        SCOPED_TRACE(file);
        const auto hits = hits_of("reference", load_scene(world_file(file), options(false)).scene);
        for (std::size_t i = 0; i < beams; ++i) {
            ASSERT_EQ(hits[i].met(), truth[i].met()) << "beam " << i;
            if (!hits[i].met()) continue;
            EXPECT_NEAR(hits[i].range_m, truth[i].range_m, 1e-4) << "beam " << i;
        }
    }
}

class WorldsWithLidars : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, WorldsWithLidars,
                         ::testing::Values("lidar.sdf", "robot_with_lidar.urdf"),
                         [](const auto& test) { return test_name_of(test.param); });

TEST_P(WorldsWithLidars, havePlacesForThem) {
    const auto scene = load_scene(world_file(GetParam()), options(false)).scene;
    const auto place = std::ranges::find_if(
        scene->frames, [](const Frame& frame) { return frame.lidar.has_value(); });
    ASSERT_NE(place, scene->frames.end());
    EXPECT_TRUE(place->name.ends_with("::lidar")) << place->name;
    EXPECT_EQ(place->lidar->samples, 1081);
    EXPECT_DOUBLE_EQ(place->lidar->max_range_m, 30.0);
    EXPECT_DOUBLE_EQ(place->lidar->rate_hz, 40.0);
}

}  // namespace
}  // namespace scipd::sim
