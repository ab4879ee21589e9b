// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Maps whose walls are where the semantics of map_server says, seen by the reference backend. What
// is unknown becomes a wall where a test asks for it, so that it can be told from what is free.
#include "sim/loaders/map/ros_map.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/map/map_folder.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int black = 0;
constexpr int grey = 205;
constexpr int white = 254;

const MapOptions unknown_is_wall{.unknown = UnknownCells::wall};

TEST(RosMap, thePictureIsFoundInAnyCase) {
    MapFolder files;
    const auto loaded =
        files.load("Hall.PGM", pgm(1, {black}),
                   "image: hall.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    EXPECT_EQ(loaded.scene->objects.size(), 1U);
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("Hall.PGM here; it is used")));
}

// Which yaml-cpp tells by the byte order mark.
TEST(RosMap, theYamlMayBeUtf16) {
    std::string wide = "\xFF\xFE";
    for (const char c : yaml("a.pgm"))
        wide += {c, '\0'};
    MapFolder files;
    EXPECT_EQ(files.load("a.pgm", pgm(1, {black}), wide).scene->objects.size(), 1U);
}

TEST(RosMap, rowsAreFromTheTopAndTheOriginIsTheLowerLeftCorner) {
    MapFolder files;
    const auto loaded = files.load("a.pgm", pgm(3, {white, white, black, white, white, white}),
                                   "image: a.pgm\nresolution: 0.5\norigin: [10, 20, 0]\nnegate: 0\n"
                                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    EXPECT_THAT(loaded.warnings, IsEmpty());
    Probe probe{loaded.scene};
    // The black pixel is the right one of the upper row: x 11 to 11.5, y 20.5 to 21.
    EXPECT_NEAR(probe.cast({10.0, 20.75, 1.0}, {1, 0, 0}).range_m, 1.0, 1e-6);
    EXPECT_NEAR(probe.cast({12.0, 20.75, 1.0}, {-1, 0, 0}).range_m, 0.5, 1e-6);
    EXPECT_NEAR(probe.cast({11.25, 20.0, 1.0}, {0, 1, 0}).range_m, 0.5, 1e-6);
    EXPECT_NEAR(probe.cast({11.25, 22.0, 1.0}, {0, -1, 0}).range_m, 1.0, 1e-6);
    EXPECT_FALSE(probe.cast({10.0, 20.25, 1.0}, {1, 0, 0}).met());
    EXPECT_FALSE(probe.cast({10.75, 20.0, 1.0}, {0, 1, 0}).met());
}

TEST(RosMap, yawTurnsAboutTheLowerLeftCorner) {
    MapFolder files;
    // One black cell at x 1 to 2, y 0 to 1 of the map, which is turned by 30 degrees about (5, -3).
    const auto loaded =
        files.load("a.pgm", pgm(3, {white, black, white}),
                   "image: a.pgm\nresolution: 1\norigin: [5, -3, 0.5235987755982988]"
                   "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
    Probe probe{loaded.scene};
    const double cosine = std::cos(std::numbers::pi / 6);
    const double sine = std::sin(std::numbers::pi / 6);
    // From the origin along the map's own x axis, a little above it.
    const glm::dvec3 along{cosine, sine, 0};
    const glm::dvec3 up{-sine, cosine, 0};
    const glm::dvec3 corner{5, -3, 0};
    const glm::dvec3 half{0, 0, 1};
    EXPECT_NEAR(probe.cast(corner + 0.25 * up + half, along).range_m, 1.0, 1e-6);
    EXPECT_NEAR(probe.cast(corner + 1.5 * along + 3.0 * up + half, -up).range_m, 2.0, 1e-6);
    // Along x of W the same face is met at 30 degrees, and from too low it is passed by.
    EXPECT_NEAR(probe.cast(corner + 0.75 * up + half, {1, 0, 0}).range_m, 1.0 / cosine, 1e-6);
    EXPECT_FALSE(probe.cast(corner + 0.25 * up + half, {1, 0, 0}).met());
}

TEST(RosMap, wallsStandBetweenTwoHeightsAndAreClosedAboveAndBelow) {
    MapFolder files;
    const auto loaded = files.load("a.pgm", pgm(1, {black}), yaml("a.pgm"),
                                   {.bottom_m = 0.5, .top_m = 1.25, .material = "concrete"});
    Probe probe{loaded.scene};
    EXPECT_NEAR(probe.cast({0.3, 0.6, 3.0}, {0, 0, -1}).range_m, 1.75, 1e-6);
    EXPECT_NEAR(probe.cast({0.3, 0.6, 0.0}, {0, 0, 1}).range_m, 0.5, 1e-6);
    EXPECT_TRUE(probe.cast({-1.0, 0.5, 0.51}, {1, 0, 0}).met());
    EXPECT_FALSE(probe.cast({-1.0, 0.5, 0.49}, {1, 0, 0}).met());
    EXPECT_TRUE(probe.cast({-1.0, 0.5, 1.24}, {1, 0, 0}).met());
    EXPECT_FALSE(probe.cast({-1.0, 0.5, 1.26}, {1, 0, 0}).met());
    const Hit hit = probe.cast({-1.0, 0.5, 1.0}, {1, 0, 0});
    EXPECT_EQ(loaded.scene->materials[hit.material].name, "concrete");
}

TEST(RosMap, isOneModelThatNeverMoves) {
    MapFolder files;
    const auto scene = files.load("a.pgm", pgm(1, {black}), yaml("a.pgm")).scene;
    EXPECT_EQ(scene->name, "map");
    ASSERT_EQ(scene->models.size(), 1U);
    EXPECT_EQ(scene->models[0].name, "map");
    EXPECT_FALSE(scene->models[0].movable);
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(scene->objects[0].name, "map::walls");
}

TEST(RosMap, isExactFarFromItsOrigin) {
    MapFolder files;
    const auto scene =
        files
            .load("a.pgm", pgm(2, {white, black}),
                  "image: a.pgm\nresolution: 0.05\norigin: [500000.3, 5400000.7, 0]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
            .scene;
    EXPECT_EQ(scene->anchor_m, glm::dvec3(500000, 5400001, 1));
    Probe probe{scene};
    EXPECT_NEAR(probe.cast({500000.0, 5400000.72, 1.0}, {1, 0, 0}).range_m, 0.35, 1e-6);
    auto embree = make_backend("embree", scene);
    const Pose there = pose_from_rpy({500000.0, 5400000.72, 1.0}, {0, 0, 0});
    const glm::vec3 ahead{1, 0, 0};
    Hit hit;
    embree->cast({.directions = {&ahead, 1}, .world_from_sensor = {&there, 1}}, {&hit, 1});
    EXPECT_NEAR(hit.range_m, 0.35, 1e-5);
}

TEST(RosMap, unknownCellsAreFreeOrWallsOrOfTheirOwnMaterial) {
    MapFolder files;
    const auto picture = pgm(3, {black, grey, white});
    const auto text = yaml("a.pgm");
    EXPECT_EQ(Probe{files.load("a.pgm", picture, text).scene}.row(3), "#..");
    EXPECT_EQ(Probe{files.load("a.pgm", picture, text, unknown_is_wall).scene}.row(3), "##.");

    const auto scene = files.load("a.pgm", picture, text, {.unknown = UnknownCells::unknown}).scene;
    Probe probe{scene};
    EXPECT_EQ(probe.row(3), "##.");
    const auto material_at = [&](double x_m) {
        return scene->materials[probe.cast({x_m, 0.5, 9.0}, {0, 0, -1}).material].name;
    };
    EXPECT_EQ(material_at(0.5), "wall");
    EXPECT_EQ(material_at(1.5), "unknown");
}

TEST(RosMap, trinaryIsStrictOnBothThresholds) {
    MapFolder files;
    // Occupancies of 0.2, 0.6 and 0.8: those of 204, 102 and 51, as a decimal and as a division.
    const auto picture = pgm(4, {204, 102, 51, black});
    const auto row = [&](const std::string& thresholds, const MapOptions& options = {}) {
        return Probe{files.load("a.pgm", picture, yaml("a.pgm", thresholds), options).scene}.row(4);
    };
    EXPECT_EQ(row("occupied_thresh: 0.6\n"), "..##");
    EXPECT_EQ(row("occupied_thresh: 0.5999999999\n"), ".###");
    EXPECT_EQ(row("occupied_thresh: 0.8\n"), "...#");
    // What is not below free_thresh is unknown.
    EXPECT_EQ(row("free_thresh: 0.2\n", unknown_is_wall), "####");
    EXPECT_EQ(row("free_thresh: 0.2000000001\n", unknown_is_wall), ".###");
    EXPECT_EQ(row("occupied_thresh: 0.8\nfree_thresh: 0.6\n", unknown_is_wall), ".###");
    EXPECT_EQ(row("occupied_thresh: 0.8\nfree_thresh: 0.6000000001\n", unknown_is_wall), "..##");
}

TEST(RosMap, negateMakesBrightOccupied) {
    MapFolder files;
    const auto load = [&](const std::string& negate) {
        return Probe{files
                         .load("a.pgm", pgm(3, {black, 102, 255}),
                               "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: " + negate +
                                   "\noccupied_thresh: 0.65\nfree_thresh: 0.4\n",
                               unknown_is_wall)
                         .scene}
            .row(3);
    };
    EXPECT_EQ(load("0"), "##.");
    EXPECT_EQ(load("false"), "##.");
    // Strict here as well: 102 is an occupancy of 0.4 now.
    EXPECT_EQ(load("1"), ".##");
    EXPECT_EQ(load("true"), ".##");
}

TEST(RosMap, trinaryTakesAlphaForAColour) {
    MapFolder files;
    // Grey and alpha. Opaque black is (0 + 0 + 0 + 255) / 4: 0.75 occupied; transparent black 1;
    // transparent white 0.25; opaque white 0.
    const auto picture = png(4, 2, {0, 255, 0, 0, 255, 0, 255, 255});
    const auto row = [&](const std::string& thresholds, const MapOptions& options = {}) {
        return Probe{files.load("a.png", picture, yaml("a.png", thresholds), options).scene}.row(4);
    };
    EXPECT_EQ(row(""), "##..");
    EXPECT_EQ(row("occupied_thresh: 0.75\n"), ".#..");
    EXPECT_EQ(row("free_thresh: 0.25\n", unknown_is_wall), "###.");
    EXPECT_EQ(row("free_thresh: 0.2500001\n", unknown_is_wall), "##..");
}

TEST(RosMap, coloursCountByTheirMean) {
    MapFolder files;
    // Pure red is a third of the light: 0.667 occupied. The sum of the last is 268: 0.6497.
    const std::vector<int> colours{255, 0, 0, 0, 0, 255, 255, 13, 0};
    EXPECT_EQ(Probe{files.load("a.png", png(3, 3, colours), yaml("a.png")).scene}.row(3), "##.");
    std::vector<int> with_alpha;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        with_alpha.push_back(colours[i]);
        if (i % 3 == 2) with_alpha.push_back(255);
    }
    // (255 + 255) / 4 of the light: only half occupied.
    EXPECT_EQ(Probe{files
                        .load("a.png", png(3, 4, with_alpha),
                              yaml("a.png",
                                   "occupied_thresh: "
                                   "0.49\n"))
                        .scene}
                  .row(3),
              "##.");
    EXPECT_EQ(
        Probe{files.load("a.png", png(3, 4, with_alpha), yaml("a.png", "mode: scale\n")).scene}.row(
            3),
        "##.");
}

TEST(RosMap, scaleTakesWhatIsNotOpaqueForUnknown) {
    MapFolder files;
    const auto picture = png(4, 2, {0, 255, 0, 254, 255, 254, 255, 255});
    const auto text = yaml("a.png", "mode: scale\n");
    EXPECT_EQ(Probe{files.load("a.png", picture, text).scene}.row(4), "#...");
    EXPECT_EQ(Probe{files.load("a.png", picture, text, unknown_is_wall).scene}.row(4), "###.");
    // Between the thresholds it is neither, as in trinary; without alpha all is opaque.
    const auto greys = pgm(3, {black, 128, white});
    const auto grey_text = yaml("b.pgm", "mode: scale\n");
    EXPECT_EQ(Probe{files.load("b.pgm", greys, grey_text).scene}.row(3), "#..");
    EXPECT_EQ(Probe{files.load("b.pgm", greys, grey_text, unknown_is_wall).scene}.row(3), "##.");
}

TEST(RosMap, rawTakesThePercentFromTheByte) {
    MapFolder files;
    const auto picture = pgm(7, {0, 19, 25, 65, 66, 100, 101});
    const auto text = yaml("a.pgm", "mode: raw\n");
    EXPECT_EQ(Probe{files.load("a.pgm", picture, text).scene}.row(7), "....##.");
    EXPECT_EQ(Probe{files.load("a.pgm", picture, text, unknown_is_wall).scene}.row(7), "..#####");
    // Negate means nothing here, as with nav2.
    const auto negated =
        "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 1\nmode: raw\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    EXPECT_EQ(Probe{files.load("a.pgm", picture, negated).scene}.row(7), "....##.");
    // Alpha neither: 90 opaque, 90 transparent.
    EXPECT_EQ(
        Probe{files.load("b.png", png(2, 2, {90, 255, 90, 0}), yaml("b.png", "mode: raw\n")).scene}
            .row(2),
        "##");
}

TEST(RosMap, thresholdsThatAreLeftOutAreThoseOfRos1) {
    MapFolder files;
    const auto loaded =
        files.load("a.pgm", pgm(4, {89, 90, grey, 206}),
                   "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n", unknown_is_wall);
    // 205 is what savers write for unknown: 0.19608 is not below 0.196. 90 is 0.647.
    EXPECT_EQ(Probe{loaded.scene}.row(4), "###.");
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("no occupied_thresh; 0.65 is taken"),
                                             HasSubstr("no free_thresh; 0.196 is taken")));
    EXPECT_EQ(Probe{files.load("a.pgm", pgm(3, {89, 90, grey}), yaml("a.pgm")).scene}.row(3),
              "#..");
}

TEST(RosMap, picturesOfEveryDepth) {
    MapFolder files;
    const auto row = [&](const std::string& image, const std::string& picture) {
        return Probe{files.load(image, picture, yaml(image, "occupied_thresh: 0.5\n")).scene}.row(
            3);
    };
    EXPECT_EQ(row("a.pgm", "P2 # a comment\n# another\n3 1\n# and one more\n255\n0 127 128\n"),
              "##.");
    EXPECT_EQ(row("b.pgm", "P2 3 1 100 0 49 50"), "##.");
    EXPECT_EQ(row("c.pgm", std::string("P5 3 1 100\n") + '\0' + '1' + '2'), "##.");
    // 16 bits: 0x7FFF is just below a half, 0x8000 just above.
    const std::string wide{0, 0, '\x7f', '\xff', '\x80', 0};
    EXPECT_EQ(row("d.pgm", "P5 3 1 65535\n" + wide), "##.");
    EXPECT_EQ(row("e.png", odd_png(3, 1, 16, 0, '\0' + wide)), "##.");
    // One bit: black, black, white.
    EXPECT_EQ(row("f.png", odd_png(3, 1, 1, 0, std::string{0, '\x20'})), "##.");
}

// Rows of a BMP are from the bottom, or from the top where its height is negative.
TEST(RosMap, aBmp) {
    MapFolder files;
    const std::vector<int> greys{white, white, white, black, white, black};
    for (const int height : {2, -2}) {
        const auto scene = files.load("a.bmp", bmp(3, height, greys), yaml("a.bmp")).scene;
        Probe probe{scene};
        EXPECT_EQ(probe.row(3), "#.#");
        EXPECT_LT(probe.top_m(0.5, 1.5), 0.F);
    }
}

/// Values of a TIFF's PhotometricInterpretation (TIFF 6.0, section 8).
constexpr std::pair<int, int> white_is_zero{262, 0};
constexpr std::pair<int, int> black_is_zero{262, 1};
constexpr std::pair<int, int> rgb{262, 2};

TEST(RosMap, aTiff) {
    MapFolder files;
    const auto row = [&](const std::string& picture, const std::string& more = "") {
        const auto scene = files.load("a.tif", picture, yaml("a.tif", more)).scene;
        Probe probe{scene};
        EXPECT_LT(probe.top_m(0.5, 1.5), 0.F);
        return probe.row(3);
    };
    const std::vector<int> greys{white, white, white, black, white, black};
    EXPECT_EQ(row(tiff(3, 1, greys, {black_is_zero})), "#.#");
    const std::vector<int> inverse{black, black, black, black, white, black};
    EXPECT_EQ(row(tiff(3, 1, inverse, {white_is_zero})), ".#.");
    std::vector<int> colours;
    for (const int grey : greys)
        colours.insert(colours.end(), {grey, grey, 0});
    EXPECT_EQ(row(tiff(3, 3, colours, {rgb})), "#.#");
    // The alpha of a TIFF is a sample of its own, unassociated (ExtraSamples 2), and counts in mode
    // trinary as it does in a PNG: (0 + 0 + 0 + 255) / 4 is an occupancy of 0.75.
    std::vector<int> with_alpha;
    for (const int grey : greys)
        with_alpha.insert(with_alpha.end(), {grey, grey, grey, 255});
    EXPECT_EQ(row(tiff(3, 4, with_alpha, {rgb, {338, 2}}), "occupied_thresh: 0.74\n"), "#.#");
    EXPECT_EQ(row(tiff(3, 4, with_alpha, {rgb, {338, 2}}), "occupied_thresh: 0.76\n"), "...");
}

TEST(RosMap, aJpeg) {
    MapFolder files;
    // Blocks of 8 x 8: black, grey of 102 and white from left to right.
    std::vector<int> greys;
    for (int row = 0; row < 8; ++row) {
        for (const int value : {black, 102, white})
            greys.insert(greys.end(), 8, value);
    }
    const auto row = [&](const std::string& threshold) {
        return Probe{files
                         .load("a.jpg", jpeg(24, greys),
                               yaml("a.jpg", "occupied_thresh: " + threshold + "\n"))
                         .scene}
            .row(24);
    };
    // 102 is an occupancy of 0.6.
    EXPECT_EQ(row("0.59"), "################........");
    EXPECT_EQ(row("0.61"), "########................");
}

TEST(RosMap, modesInAnyCase) {
    MapFolder files;
    const auto picture = pgm(2, {66, 254});
    // A percent of 66 is occupied; a grey of 66 is, too, and one of 254 is not.
    EXPECT_EQ(
        Probe{files.load("a.pgm", pgm(2, {66, 30}), yaml("a.pgm", "mode: Raw\n")).scene}.row(2),
        "#.");
    for (const std::string mode : {"Trinary", "SCALE"}) {
        EXPECT_EQ(
            Probe{files.load("a.pgm", picture, yaml("a.pgm", "mode: " + mode + "\n")).scene}.row(2),
            "#.");
    }
}

TEST(RosMap, theImageLiesBesideTheYamlOrWhereItIsToldTo) {
    MapFolder files;
    const auto picture = pgm(1, {black});
    EXPECT_EQ(files.load("maps/a.pgm", picture, yaml("maps/a.pgm")).scene->objects.size(), 1U);
    EXPECT_EQ(files.load("a.pgm", picture, yaml((files.folder().path() / "a.pgm").string()))
                  .scene->objects.size(),
              1U);
    ASSERT_EQ(setenv("HOME", files.folder().path().c_str(), 1), 0);
    files.folder().write("b.pgm", picture);
    EXPECT_EQ(files.load("elsewhere/a.pgm", picture, yaml("~/b.pgm")).scene->objects.size(), 1U);
}

}  // namespace
}  // namespace scipd::sim
