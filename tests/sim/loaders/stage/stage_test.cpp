// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds of Stage, whose ranges are known.
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/every_backend.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/map/map_folder.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double none = std::numeric_limits<double>::infinity();

/// A frame of one dark pixel within a white margin.
std::string frame(int side, int margin) {
    std::vector<int> greys;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const int rim = std::min({row, column, side - 1 - row, side - 1 - column});
            greys.push_back(rim == margin ? 0 : 255);
        }
    }
    return pgm(static_cast<std::size_t>(side), greys);
}

class Stage : public ::testing::Test {
  protected:
    LoadedScene load(const std::string& text) { return load_scene(folder_.write("a.world", text)); }
    SharedScene scene(const std::string& text) {
        auto loaded = load(text);
        EXPECT_THAT(loaded.warnings, IsEmpty());
        return loaded.scene;
    }
    std::vector<std::string> faults(const std::string& text) {
        return faults_of([&] { load(text); }, folder_);
    }
    std::vector<std::string> warnings(const std::string& text) {
        return without_folder(load(text).warnings, folder_);
    }
    tests::TempDir folder_;
};

TEST_F(Stage, aBitmapIsFoundInAnyCase) {
    folder_.write("bitmaps/Room.PGM", frame(8, 0));
    const std::string text = "model ( name \"r\" size [8 8 2] bitmap \"bitmaps/room.pgm\" )\n";
    EXPECT_THAT(load(text).scene->objects, SizeIs(1));
    EXPECT_THAT(warnings(text), ElementsAre(HasSubstr("is called bitmaps/Room.PGM here")));
}

TEST_F(Stage, aSquareRoom) {
    folder_.write("bitmaps/room.pgm", frame(8, 0));
    folder_.write("map.inc", "define floorplan model ( color \"gray30\" boundary 0 )\n");
    const auto room = scene(
        "# a comment\ninclude \"map.inc\"  # another\nresolution 0.02\n"
        "window ( size [ 600 700 ] scale 28 )\n"
        "floorplan ( name \"room\" size [8.000 8.000 2] pose [1 2 0 0] "
        "bitmap \"bitmaps/room.pgm\" )\n");
    // Pixels of 1 m, of which the frame takes one on each side.
    const glm::dvec3 middle_m{1, 2, 1};
    expect_range(room, middle_m, {1, 0, 0}, 3.0);
    expect_range(room, middle_m, {0, -1, 0}, 3.0);
    expect_range(room, middle_m, {1, 1, 0}, 3.0 * std::sqrt(2.0));
    expect_range(room, middle_m, {0, 0, 1}, none);
    expect_range(room, {1, 2, 1.99}, {-1, 0, 0}, 3.0);
    expect_range(room, {1, 2, 2.01}, {-1, 0, 0}, none);
    expect_range(room, {-9, 2, 1}, {1, 0, 0}, 6.0);
    ASSERT_THAT(room->models, SizeIs(1));
    EXPECT_EQ(room->models[0].name, "room");
    EXPECT_FALSE(room->models[0].movable);
}

// What is dark is stretched over the size, not the picture: a boundary is of the whole size then.
TEST_F(Stage, aBitmapIsAsLargeAsWhatIsDark) {
    folder_.write("room.pgm", frame(12, 2));
    const auto room = scene("model ( size [4 8 1] bitmap \"room.pgm\" )");
    expect_range(room, {0, 0, 0.5}, {1, 0, 0}, 1.5);
    expect_range(room, {0, 0, 0.5}, {0, 1, 0}, 3.0);
    const auto turned =
        scene("model ( size [4 8 1] pose [0 0 0 90] boundary 1 bitmap \"room.pgm\" )");
    expect_range(turned, {0, 0, 0.5}, {1, 0, 0}, 3.0);
    expect_range(turned, {5, 0, 0.5}, {-1, 0, 0}, 1.0);
}

TEST_F(Stage, aBoundaryIsACentimetreThick) {
    const auto room = scene("model ( size [6 4 1] noblocks 1 boundary 1 )");
    expect_range(room, {0, 0, 0.5}, {1, 0, 0}, 2.99);
    expect_range(room, {0, 0, 0.5}, {0, -1, 0}, 1.99);
    expect_range(room, {9, 0, 0.5}, {-1, 0, 0}, 6.0);
}

TEST_F(Stage, modelsAreBoxesUnlessTheySayMore) {
    const auto one = scene("model ( size [2 1 0.5] pose [5 0 1 0] origin [0.5 0 0 0] )");
    expect_range(one, {0, 0, 1.25}, {1, 0, 0}, 4.5);
    expect_range(one, {0, 0, 0.99}, {1, 0, 0}, none);
    expect_range(one, {0, 0, 1.51}, {1, 0, 0}, none);
    // As Stage has it where nothing is said: 0.4 by 0.4 by 1.
    expect_range(scene("model ( pose [5 0 0 0] )"), {0, 0, 0.99}, {1, 0, 0}, 4.8);
    expect_range(scene("unit_length \"cm\" unit_angle \"radians\"\n"
                       "model ( size [100 200 100] pose [500 0 0 1.5707963267948966] )"),
                 {0, 0, 0.5}, {1, 0, 0}, 4.0);
}

// A wedge from (0, 0) to (1, 0) and (0, 2), from 1 to 2: stretched to 2 by 2 by 0.5.
TEST_F(Stage, blocksAreStretchedToTheSize) {
    const auto wedge = scene(
        "model ( size [2 2 0.5]\n"
        "  block ( points 3 point[0] [0 0] point[1] [1 0] point[2] [0 2] z [1 2] ) )");
    expect_range(wedge, {-5, 0, 0.75}, {1, 0, 0}, 4.0);
    expect_range(wedge, {5, 0, 0.75}, {-1, 0, 0}, 5.0);
    expect_range(wedge, {5, 0, 0.45}, {-1, 0, 0}, none);
    expect_range(wedge, {-0.5, -0.5, 5}, {0, 0, -1}, 4.0);
    expect_range(wedge, {0.5, 0.9, 5}, {0, 0, -1}, none);
}

TEST_F(Stage, childrenStandOnTopUnlessTheyAreToldNotTo) {
    const std::string tower =
        "size [1 1 1] pose [3 0 0 90]\n model ( size [1 1 0.5] pose [2 0 0 0] )";
    // 2 m along the parent's x, which points along y.
    const auto on_top = scene("model ( " + tower + " )");
    expect_range(on_top, {3, 9, 1.25}, {0, -1, 0}, 6.5);
    expect_range(on_top, {3, 9, 0.25}, {0, -1, 0}, 8.5);
    const auto beside = scene("model ( stack_children 0 " + tower + " )");
    expect_range(beside, {3, 9, 0.25}, {0, -1, 0}, 6.5);
    EXPECT_THAT(beside->models, SizeIs(1));
}

TEST_F(Stage, robotsMoveAndTheirSensorsAreNothing) {
    const auto robots = scene(
        "define sick laser ( size [0.1 0.1 0.1] samples 180 )\n"
        "define pioneer position ( size [0.5 0.5 0.2] drive \"diff\"\n"
        "  block ( points 4 point[0] [1 1] point[1] [1 -1] point[2] [-1 -1] point[3] [-1 1] z [0 "
        "1] )"
        ")\n"
        "pioneer ( name \"r\" pose [2 0 0 0] sick ( pose [0 0 0.1 0] ) )\n"
        "pioneer ( name \"r\" pose [-2 0 0 0] )\n");
    ASSERT_THAT(robots->models, SizeIs(2));
    EXPECT_EQ(robots->models[0].name, "r");
    EXPECT_EQ(robots->models[1].name, "r:1");
    EXPECT_TRUE(robots->models[0].movable);
    EXPECT_THAT(robots->objects, SizeIs(2));
    expect_range(robots, {0, 0, 0.1}, {1, 0, 0}, 1.75);
}

// Finding a free number for each by counting from 1 takes 17 s.
TEST_F(Stage, manyModelsWithoutNamesAreNumberedSoon) {
    std::string text;
    for (int i = 0; i < 20'000; ++i)
        text += "model ( pose [" + std::to_string(i % 100) + ' ' + std::to_string(i / 100) +
                " 0 0] )\n";
    const auto begun = std::chrono::steady_clock::now();
    const auto world = scene(text);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
    ASSERT_THAT(world->models, SizeIs(20'000));
    EXPECT_EQ(world->models[1].name, "model:1");
    EXPECT_EQ(world->models.back().name, "model:19999");
}

TEST_F(Stage, whatRangersDoNotSeeIsNotThere) {
    EXPECT_THAT(faults("model ( ranger_return -1 )"), IsEmpty());
    const auto world = load(
        "model ( ranger_return -1 pose [2 0 0 0] ) model ( pose [4 0 0 0] )"
        "model ( laser_return 0 pose [3 0 0 0] )");
    expect_range(world.scene, {0, 0, 0.5}, {1, 0, 0}, 3.8);
}

TEST_F(Stage, ofDefinitionsTheLastWordCounts) {
    const auto world = scene(
        "define wall model ( size [1 1 1] )\n"
        "define high_wall wall ( size [1 1 3] )\n"
        "high_wall ( pose [2 0 0 0] )\n");
    expect_range(world, {0, 0, 2.9}, {1, 0, 0}, 1.5);
}

TEST_F(Stage, headingsOfStage2AreTakenAndTold) {
    EXPECT_THAT(warnings("\nmodel ( size [2 1 1] pose [3 0 90] ) model ( pose [9 0 0] )"),
                ElementsAre("a.world:2: pose has three numbers: x, y and heading are taken, as "
                            "Stage 2 has them"));
    expect_range(load("model ( size [2 1 1] pose [3 0 90] )").scene, {0, 0, 0.5}, {1, 0, 0}, 2.5);
}

TEST_F(Stage, whatIsMissingOrFaultyIsLeftOutAndTold) {
    EXPECT_THAT(
        warnings("include \"robots.inc\"\n"
                 "model ( bitmap \"none.png\" )\n"
                 "pioneer ( pose [1 1 0 0] )\n"
                 "model ( name \"flat\" size [1 1 0] )\n"
                 "model ( name \"odd\" pose [\"here\" 0 0 0] )\n"
                 "model ( size [1 1 1] )\n"
                 "model ( name \"line\" block ( points 2 point[0] [0 0] point[1] [1 0] ) )\n"),
        ElementsAre("a.world:1: there is no 'robots.inc' beside the world or this file; left out",
                    "a.world:2: none.png: no such file; a bitmap is wanted here; left out",
                    "a.world:3: 'pioneer' is no model that is known; left out",
                    "a.world:4: flat: every size must be above 0 and up to 1e7 m; left out",
                    "a.world:5: odd: pose must be numbers, not 'here'; left out",
                    "a.world:7: line: a block has from 3 to 1000 points; left out"));
    folder_.write("white.pgm", pgm(2, {255, 255}));
    EXPECT_THAT(warnings("model ( bitmap \"white.pgm\" ) model ( )"),
                ElementsAre("a.world:1: white.pgm has no dark pixel, and so no wall"));
}

// A definition that lies in a file nobody has.
TEST_F(Stage, whatIsNeitherDefinedNorKnownCountsByWhatItSays) {
    folder_.write("room.pgm", frame(8, 0));
    const std::string text =
        "\nfloorplan ( name \"room\" size [8 8 2] bitmap \"room.pgm\" )\n"
        "floorplan ( name \"other\" size [8 8 2] pose [20 0 0 0] bitmap \"room.pgm\" )\n"
        "ghost ( ranger_return -1 )\n"
        "crate ( size [1 1 1] pose [1 0 0 0] )\n";
    EXPECT_THAT(warnings(text),
                ElementsAre("a.world:2: 'floorplan' is neither defined nor a model of Stage; its "
                            "properties are used, here and elsewhere",
                            "a.world:4: 'ghost' is neither defined nor a model of Stage; its "
                            "properties are used, here and elsewhere",
                            "a.world:5: 'crate' is no model that is known; left out"));
    expect_range(load(text).scene, {0, 0, 1}, {1, 0, 0}, 3.0);
}

TEST_F(Stage, aWorldInUtf16IsCalledSo) {
    const std::string little = std::string("\xFF\xFEm\0o\0d\0e\0l\0", 12);
    const std::string big = std::string("\xFE\xFF\0m\0o\0d\0e\0l", 12);
    for (const std::string& text : {little, big}) {
        EXPECT_THAT(faults(text), ElementsAre("a.world: is in UTF-16; save it as UTF-8"));
        folder_.write("b.inc", text);
        EXPECT_THAT(faults("include \"b.inc\"\n"),
                    ElementsAre("b.inc: is in UTF-16; save it as UTF-8"));
    }
}

TEST_F(Stage, whatIsNoWorldOfStage) {
    EXPECT_THAT(faults("size = 3\n"),
                ElementsAre("a.world:1: '=' means nothing to Stage; is it a Stage world?"));
    EXPECT_THAT(faults("\nmodel ( name \"a\n"),
                ElementsAre("a.world:2: a text has no closing quote"));
    EXPECT_THAT(faults("model ( size [1 1 1]"),
                ElementsAre("a.world: ends where a closing bracket should be"));
    EXPECT_THAT(faults("model )\n"), ElementsAre("a.world:1: 'model' has no value"));
    EXPECT_THAT(faults("model ( 3 )\n"), ElementsAre("a.world:1: '3' stands where a word should"));
    EXPECT_THAT(faults("define a model [ 1 ]\n"), ElementsAre("a.world:1: define wants brackets"));
    EXPECT_THAT(faults("model ( size [1 a] )\n"),
                ElementsAre("a.world:1: a list holds numbers and texts, not 'a'"));
}

TEST_F(Stage, aWorldThatIsXmlIsGazebos) {
    const auto loaded = load(
        "\n<!-- model ( ) -->\n<sdf version='1.6'><world name='w'><model name='m'><link name='l'>"
        "<visual name='v'><geometry><box><size>2 2 2</size></box></geometry></visual></link>"
        "</model></world></sdf>");
    expect_range(loaded.scene, {3, 0, 0}, {-1, 0, 0}, 2.0);
}

TEST_F(Stage, includesAndDefinitionsThatGoInCirclesAreRefused) {
    folder_.write("b.inc", "include \"b.inc\"\n");
    EXPECT_THAT(faults("include \"b.inc\"\n"),
                ElementsAre("b.inc:1: includes nest deeper than 16; do they go in circles?"));
    EXPECT_THAT(faults("define a a ( )\na ( )\n"),
                ElementsAre(HasSubstr("does a definition use itself?")));
    std::string laughs = "define a0 model ( )\n";
    for (int i = 1; i < 12; ++i) {
        std::string before{"a"};
        before.append(std::to_string(i - 1)).append(" ( ) ");
        laughs.append("define a").append(std::to_string(i)).append(" model ( ");
        for (int k = 0; k < 10; ++k)
            laughs += before;
        laughs += ")\n";
    }
    EXPECT_THAT(faults(laughs + "a11 ( )\n"), ElementsAre(HasSubstr("has too many models")));
}

}  // namespace
}  // namespace scipd::sim
