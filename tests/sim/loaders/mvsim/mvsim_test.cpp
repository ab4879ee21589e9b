// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds of MVSim, whose ranges are known.
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

class Mvsim : public ::testing::Test {
  protected:
    LoadedScene load(const std::string& inside) {
        return load_scene(folder_.write(
            "a.world.xml", "<mvsim_world version=\"1.0\">\n" + inside + "</mvsim_world>\n"));
    }
    SharedScene scene(const std::string& inside) {
        auto loaded = load(inside);
        EXPECT_THAT(loaded.warnings, IsEmpty());
        return loaded.scene;
    }
    std::vector<std::string> faults(const std::string& inside) {
        return faults_of([&] { load(inside); }, folder_);
    }
    std::vector<std::string> warnings(const std::string& inside) {
        return without_folder(load(inside).warnings, folder_);
    }
    tests::TempDir folder_;
};

// Walls of 0.2 m between the corners of a square of 6 m.
TEST_F(Mvsim, aSquareRoom) {
    const auto room = scene(
        "<simul_timestep>0</simul_timestep><gui><ortho>false</ortho></gui>\n"
        "<element class='ground_grid'><floating>true</floating></element>\n"
        "<element class='horizontal_plane'><x_min>-5</x_min><y_min>-5</y_min><x_max>5</x_max>"
        "<y_max>5</y_max><z>0.5</z></element>\n"
        "<walls><wallThickness>0.2</wallThickness><wallHeight>2.5</wallHeight><shape>"
        "<pt>-3 -3</pt><pt>3 -3</pt> <pt>3 -3</pt><pt>3 3</pt> <pt>3 3</pt><pt>-3 3</pt> "
        "<pt>-3 3</pt><pt>-3 -3</pt></shape></walls>\n");
    const glm::dvec3 middle_m{0, 0, 1};
    expect_range(room, middle_m, {1, 0, 0}, 2.9);
    expect_range(room, middle_m, {0, -1, 0}, 2.9);
    expect_range(room, middle_m, {-1, 1, 0}, 2.9 * std::sqrt(2.0));
    expect_range(room, middle_m, {0, 0, -1}, 0.5);
    expect_range(room, {0, 0, 2.49}, {-1, 0, 0}, 2.9);
    expect_range(room, {0, 0, 2.51}, {-1, 0, 0}, none);
    expect_range(room, {9, 3.05, 1}, {-1, 0, 0}, 5.9);
    EXPECT_THAT(room->models, SizeIs(2));
    EXPECT_FALSE(room->models[1].movable);
}

TEST_F(Mvsim, wallsThatAreTurned) {
    const auto room = scene(
        "<walls><transformation>[0 -1 0 5; 1 0 0 0; 0 0 1 0; 0 0 0 1]</transformation>"
        "<shape><pt>-1 0</pt><pt>1 0</pt><pt>9 9</pt><pt>9 8</pt></shape></walls>");
    // Along y at x 5.
    expect_range(room, {0, 0, 1}, {1, 0, 0}, 4.95);
    expect_range(room, {0, 1.01, 1}, {1, 0, 0}, none);
}

TEST_F(Mvsim, aVerticalPlaneWithADoorAndAWindow) {
    const auto wall = scene(
        "<element class='vertical_plane'><x0>4</x0><y0>-5</y0><x1>4</x1><y1>5</y1><z>0</z>"
        "<height>3</height><thickness>0.4</thickness>"
        "<door position='0.5' width='2' z_min='0' z_max='2'/>"
        "<window><position>0.75</position><width>1</width><z_min>1</z_min><z_max>2</z_max></window>"
        "</element>");
    expect_range(wall, {0, -2, 1}, {1, 0, 0}, 3.8);
    expect_range(wall, {0, 0, 1}, {1, 0, 0}, none);
    expect_range(wall, {0, 0.99, 1.99}, {1, 0, 0}, none);
    expect_range(wall, {0, 1.01, 1.99}, {1, 0, 0}, 3.8);
    expect_range(wall, {0, 0, 2.01}, {1, 0, 0}, 3.8);
    expect_range(wall, {0, 2.5, 1.5}, {1, 0, 0}, none);
    expect_range(wall, {0, 2.5, 0.9}, {1, 0, 0}, 3.8);
    // From the threshold to the door frame.
    expect_range(wall, {4, 0, 1}, {0, 1, 0}, 1.0);
}

TEST_F(Mvsim, blocksOfClasses) {
    const auto blocks = scene(
        "<block:class name='crate'><static>true</static><zmin>0.5</zmin><zmax>2</zmax>"
        "<shape><pt>-1 -1</pt><pt>-1 1</pt><pt>1 1</pt><pt>1 -1</pt></shape></block:class>\n"
        "<block class='crate' name='a'><init_pose>5 0 45</init_pose></block>\n"
        "<block class='crate'><init_pose3d>-5 0 1 0 0 0</init_pose3d><zmax>1</zmax></block>\n"
        "<block><init_pose>0 5 0</init_pose></block>\n"
        "<block><init_pose>0 -5 0</init_pose><geometry type='cylinder' radius='1' length='3' "
        "vertex_count='4'/></block>\n");
    expect_range(blocks, {0, 0, 1}, {1, 0, 0}, 5.0 - std::sqrt(2.0));
    expect_range(blocks, {0, 0, 0.45}, {1, 0, 0}, none);
    expect_range(blocks, {0, 0, 1.99}, {1, 0, 0}, 5.0 - std::sqrt(2.0));
    expect_range(blocks, {0, 0, 1.75}, {-1, 0, 0}, 4.0);
    expect_range(blocks, {0, 0, 2.05}, {-1, 0, 0}, none);
    expect_range(blocks, {0, 0, 0.99}, {0, 1, 0}, 4.5);
    // A square on its corner.
    expect_range(blocks, {0, 0, 2.9}, {0, -1, 0}, 4.0);
    ASSERT_THAT(blocks->models, SizeIs(4));
    EXPECT_EQ(blocks->models[0].name, "a");
    EXPECT_EQ(blocks->models[1].name, "block");
    EXPECT_EQ(blocks->models[2].name, "block_2");
    EXPECT_FALSE(blocks->models[0].movable);
    EXPECT_TRUE(blocks->models[2].movable);
}

TEST_F(Mvsim, loopsConditionsAndVariables) {
    folder_.write("parts/post.xml",
                  "<block name='post'><init_pose>${at} 0 0</init_pose><zmax>${high|3}</zmax>"
                  "<static>1</static></block>");
    const auto world = scene(
        "<variable name='STEP' value='2'/>\n"
        "<for var='i' from='1' to='3'><if condition='$f{i != 2 and STEP >= 2}'>"
        "<block><init_pose>0 $f{STEP*i^2 - 1 + sin(pi)} 0</init_pose></block></if></for>\n"
        "<include file='parts/post.xml' at='$f{-(2+3)*2}'/>\n"
        "<include file='parts/post.xml' at='9' high='1'/>\n");
    ASSERT_THAT(world->models, SizeIs(4));
    expect_range(world, {0, 0, 0.5}, {0, 1, 0}, 0.5);
    expect_range(world, {0, 3, 0.5}, {0, 1, 0}, 13.5);
    expect_range(world, {0, 0, 2.9}, {-1, 0, 0}, 9.5);
    expect_range(world, {0, 0, 1.1}, {1, 0, 0}, none);
}

TEST_F(Mvsim, anOccupancyGridOfAPicture) {
    folder_.write("a.pgm", pgm(3, {255, 255, 0, 255, 255, 255}));
    const auto grid = scene(
        "<element class='occupancy_grid'><file>a.pgm</file><resolution>0.5</resolution>"
        "<centerpixel_x>1</centerpixel_x><centerpixel_y>0</centerpixel_y></element>");
    // The dark pixel is the right one of the upper row: x 0.5 to 1, y 0.5 to 1.
    expect_range(grid, {-1, 0.75, 1}, {1, 0, 0}, 1.5);
    expect_range(grid, {0.75, 0, 1.9}, {0, 1, 0}, 0.5);
    expect_range(grid, {-1, 0.25, 1}, {1, 0, 0}, none);
    EXPECT_THAT(
        warnings("<element class='occupancy_grid'><file>a.pgm</file></element>"),
        ElementsAre("a.world.xml:2: has no centerpixel_x and _y; the middle of its picture is the "
                    "origin"));
    folder_.write("map.yaml", yaml("a.pgm"));
    expect_range(scene("<element class='occupancy_grid'><file>map.yaml</file></element>"),
                 {0, 1.5, 1}, {1, 0, 0}, 2.0);
}

// Black, grey and white from row to row: x grows with the rows.
TEST_F(Mvsim, anElevationMap) {
    folder_.write("hill.pgm", pgm(2, {0, 0, 100, 100, 200, 200}));
    const auto hill = scene(
        "<element class='elevation_map'><elevation_image>hill.pgm</elevation_image>"
        "<resolution>2</resolution><elevation_image_min_z>1</elevation_image_min_z>"
        "<elevation_image_max_z>3</elevation_image_max_z><corner_min_x>0</corner_min_x>"
        "<corner_min_y>-1</corner_min_y></element>");
    expect_range(hill, {0.5, 0.2, 9}, {0, 0, -1}, 7.75);
    expect_range(hill, {3.5, 0.2, 9}, {0, 0, -1}, 6.25);
    expect_range(hill, {3.5, 1.2, 9}, {0, 0, -1}, none);
}

// Each number is a height: the picture's scale does not count. x grows from row to row.
TEST_F(Mvsim, anElevationMapOfNumbers) {
    const auto map = [&](const std::string& inside) {
        return scene("<element class='elevation_map'>" + inside + "</element>");
    };
    const auto slope =
        map("<resolution>4.0</resolution><elevation_image_max_z>50</elevation_image_max_z>"
            "<elevation_data_matrix>\n [0 0; 1 1;\n  2, 2]\n</elevation_data_matrix>"
            "<corner_min_x>0</corner_min_x><corner_min_y>-1</corner_min_y>");
    expect_range(slope, {1, 0.3, 9}, {0, 0, -1}, 8.75);
    expect_range(slope, {7, 2.3, 9}, {0, 0, -1}, 7.25);
    expect_range(slope, {8.1, 0, 9}, {0, 0, -1}, none);
    expect_range(slope, {7, 3.1, 9}, {0, 0, -1}, none);
    // Along x at a height of 1.5 m.
    expect_range(slope, {-1, 0.3, 1.5}, {1, 0, 0}, 7.0);
    // A cell is cut from its corner of the least x and y, and the map lies around the origin.
    const auto fold = map("<elevation_data_matrix>[0 0 ; +0 -1]</elevation_data_matrix>");
    expect_range(fold, {0.25, -0.25, 2}, {0, 0, -1}, 2.25);
    expect_range(fold, {-0.25, 0.25, 2}, {0, 0, -1}, 2.25);
    expect_range(fold, {0.4, 0.4, 2}, {0, 0, -1}, 2.9);
    // A comment divides nothing, and a picture goes first.
    folder_.write("flat.pgm", pgm(2, {0, 0, 0, 0}));
    expect_range(map("<elevation_data_matrix>[1 <!-- m --> 1; 1 1]</elevation_data_matrix>"),
                 {0.2, 0.1, 2}, {0, 0, -1}, 1.0);
    expect_range(map("<elevation_image>flat.pgm</elevation_image>"
                     "<elevation_data_matrix>[1 1; 1 1]</elevation_data_matrix>"),
                 {0.2, 0.1, 2}, {0, 0, -1}, 2.0);
}

TEST_F(Mvsim, whatIsNoElevationMap) {
    const auto why = [&](const std::string& inside) {
        const std::string block = "<block/>";  // without it the world would be empty
        const auto told =
            warnings(block + "<element class='elevation_map'>" + inside + "</element>");
        return told.size() == 1 ? told[0] : "";
    };
    const auto of_matrix = [&](const std::string& text) {
        return why("<elevation_data_matrix>" + text + "</elevation_data_matrix>");
    };
    const std::string begins = "a.world.xml:2: <element> ";
    EXPECT_EQ(of_matrix("[1 2; 3]"),
              begins + "<elevation_data_matrix> has rows of 2 and of 1 numbers; left out");
    EXPECT_EQ(of_matrix("[1 x; 3 4]"),
              begins + "<elevation_data_matrix> wants numbers, not 'x'; left out");
    EXPECT_EQ(of_matrix("1 2; 3 4"), begins +
                                         "<elevation_data_matrix> must be in brackets, its rows "
                                         "divided by semicolons: [0 0; 1 1]; left out");
    EXPECT_EQ(of_matrix("[1 2 3 4]"),
              begins + "wants heights of 2 x 2 to 10 million places; left out");
    EXPECT_EQ(of_matrix("[]"), begins + "wants heights of 2 x 2 to 10 million places; left out");
    EXPECT_EQ(of_matrix("[1 1e9; 1 1]"), begins + "must lie within 1e7 m of the origin; left out");
    EXPECT_EQ(why(""),
              begins + "wants an <elevation_image> or an <elevation_data_matrix>; left out");
    EXPECT_EQ(why("<dem_xyzrgb_file>hill.txt</dem_xyzrgb_file>"),
              begins +
                  "wants an <elevation_image> or an <elevation_data_matrix>; a <dem_xyzrgb_file> "
                  "is not read; left out");
    EXPECT_EQ(why("<apply_kernel>1</apply_kernel><elevation_data_matrix>[1 1; 1 1]"
                  "</elevation_data_matrix>"),
              "a.world.xml:2: <apply_kernel> is not read; the heights are not smoothed");
}

TEST_F(Mvsim, aGridWithoutWallsIsAWarning) {
    folder_.write("white.pgm", pgm(2, {255, 255}));
    folder_.write("map.yaml", yaml("white.pgm"));
    const auto empty = load(
        "<element class='occupancy_grid'><file>white.pgm</file><centerpixel_x>0</centerpixel_x>"
        "<centerpixel_y>0</centerpixel_y></element>\n"
        "<element class='occupancy_grid'><file>map.yaml</file></element>");
    EXPECT_THAT(empty.scene->objects, IsEmpty());
    EXPECT_THAT(without_folder(empty.warnings, folder_),
                ElementsAre("a.world.xml:2: white.pgm has no dark pixel, and so no wall",
                            HasSubstr("white.pgm: holds no wall that a scanner could see"),
                            HasSubstr("a.world.xml: holds nothing that a scanner could see")));
    EXPECT_THAT(warnings("<block/><element class='occupancy_grid'/>"),
                ElementsAre("a.world.xml:2: <element> wants a <file>: a picture or a ROS map; left "
                            "out"));
}

TEST_F(Mvsim, commentsMayStandAnywhere) {
    const auto file = folder_.write(
        "a.world.xml",
        "<!-- made by hand -->\n<?xml version='1.0'?>\n<mvsim_world version='1.0'>\n<!-- <walls> "
        "-->"
        "<walls><shape><!-- a --><pt>3 <!-- b -->-3</pt><pt>3 3</pt></shape></walls>\n"
        "<vehicle/></mvsim_world>");
    const auto loaded = load_scene(file);
    expect_range(loaded.scene, {0, 0, 1}, {1, 0, 0}, 2.95);
    EXPECT_THAT(without_folder(loaded.warnings, folder_),
                ElementsAre(HasSubstr("a.world.xml:5: <vehicle>")));
}

TEST_F(Mvsim, whatIsLeftOutIsTold) {
    EXPECT_THAT(
        warnings("<vehicle name='r1' class='jackal'><init_pose>0 0 0</init_pose></vehicle>\n"
                 "<block><init_pose>0 0</init_pose></block>\n"
                 "<block><init_pose>$f{rand()} 0 0</init_pose></block>\n"
                 "<block><init_pose>$(date) 0 0</init_pose></block>\n"
                 "<block><visual><model_uri>shelf.dae</model_uri></visual></block>\n"
                 "<include file='none.xml'/>\n"
                 "<element class='pointcloud'/>\n"
                 "<walls><model_uri>walls.dae</model_uri></walls>\n"
                 "<actor><x/></actor>\n"
                 "<walls><wallHeight>2</wallHeight></walls>"
                 "<block><shape><pt>0 0</pt><pt>1 0</pt><pt>0 1</pt></shape>"
                 "<visual><model_uri>a.dae</model_uri></visual></block>\n"),
        ElementsAre(
            "a.world.xml:2: <vehicle> is a robot; configure it in scipd; left out",
            "a.world.xml:3: <block> <init_pose> wants 3 numbers, not '0 0'; left out",
            "a.world.xml:4: <block> the function 'rand' is not known here; left out",
            HasSubstr("a.world.xml:5: <block> uses a command or the environment"),
            "a.world.xml:6: <block> is shown by 'shelf.dae', and 3D models are not read; give it a "
            "<shape>; left out",
            "a.world.xml:7: <include> names none.xml, which is not there; left out",
            "a.world.xml:8: <element> class 'pointcloud' is not known here; left out",
            "a.world.xml:9: <walls> of a 3D model are not read; give them a <shape>; left out",
            "a.world.xml:10: <actor> is not known here; left out",
            "a.world.xml:11: <walls> has no <pt> in a <shape>, and so no wall; left out",
            "a.world.xml:11: 'a.dae' is not read; the shape counts"));
}

TEST_F(Mvsim, aWorldInUtf16IsCalledSo) {
    const auto file = folder_.write("a.world.xml", std::string("\xFF\xFE<\0m\0v\0", 8));
    EXPECT_THAT(faults_of([&] { load_scene(file); }, folder_),
                ElementsAre("a.world.xml: is in UTF-16; save it as UTF-8"));
}

TEST_F(Mvsim, whatIsNoWorldOfMvsim) {
    const auto faults_of_text = [&](const std::string& text) {
        const auto file = folder_.write("a.world.xml", text);
        return faults_of([&] { load_scene(file); }, folder_);
    };
    EXPECT_THAT(faults_of_text("<robot/>"),
                ElementsAre("a.world.xml: is no world of MVSim: its root is <robot>, not "
                            "<mvsim_world>"));
    EXPECT_THAT(faults_of_text("<mvsim_world>\n<a></b></mvsim_world>"),
                ElementsAre("a.world.xml:2: is no XML that can be read"));
    EXPECT_THAT(faults_of_text(""), ElementsAre("a.world.xml:0: is no XML that can be read"));
}

TEST_F(Mvsim, whatGoesInCirclesOrOnForEverIsRefused) {
    EXPECT_THAT(faults("<include file='a.world.xml'/>"),
                ElementsAre(HasSubstr("do they go in circles?")));
    EXPECT_THAT(faults("<for var='i' from='0' to='1e5'><for var='k' from='0' to='1e5'/></for>"),
                ElementsAre("a.world.xml:2: its loops make more than 200000 elements"));
}

// Found by fuzzing.
TEST_F(Mvsim, theNameOfOneFileTooManyIsFitToBeShown) {
    EXPECT_THAT(faults("<for var='i' from='0' to='1000'><include file='\x1B[31m\xFF.xml'/></for>"),
                ElementsAre("?[31m?.xml: is one file too many"));
}

}  // namespace
}  // namespace scipd::sim
