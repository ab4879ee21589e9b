// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Terrains from pictures that have a closed form: planes, steps, a saddle, one raised corner.
#include <cmath>
#include <functional>
#include <random>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/map/map_folder.h"
#include "tests/sim/loaders/sdf/sdf_cast.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a pixel is, from its row and its column, counted from the top left.
using Grey = std::function<int(std::size_t row, std::size_t column)>;

std::vector<int> greys(std::size_t side, const Grey& grey) {
    std::vector<int> all;
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t column = 0; column < side; ++column)
            all.push_back(grey(row, column));
    }
    return all;
}

/// 16 bits a pixel; each row after its filter byte.
std::string wide_png(std::size_t side, const Grey& grey) {
    std::string rows;
    for (std::size_t row = 0; row < side; ++row) {
        rows += '\0';
        for (std::size_t column = 0; column < side; ++column) {
            rows += static_cast<char>(grey(row, column) >> 8);
            rows += static_cast<char>(grey(row, column) & 255);
        }
    }
    const auto size = static_cast<unsigned>(side);
    return odd_png(size, size, 16, 0, rows);
}

std::string heightmap(const std::string& size, const std::string& more = {}) {
    return "<heightmap><uri>a.png</uri><size>" + size + "</size>" + more + "</heightmap>";
}

class SdfHeightmap : public SdfCast {
  protected:
    void load_terrain(const std::string& picture, const std::string& geometry,
                      const std::string& pose = {}) {
        folder_.write("a.png", picture);
        load(world(model_of(visual("v", geometry, pose))));
    }
};

INSTANTIATE_TEST_SUITE_P(Backends, SdfHeightmap, ::testing::Values("reference", "embree"),
                         name_of_backend);

TEST_P(SdfHeightmap, ARampIsAPlane) {
    // From 0 in the west to 2 m in the east of 8 m.
    load_terrain(wide_png(17, [](auto, auto column) { return static_cast<int>(4095 * column); }),
                 heightmap("8 4 2"));
    EXPECT_THAT(warnings_, IsEmpty());
    for (double x = -3.95; x < 4.0; x += 0.37) {
        for (const double y : {-1.99, -0.3, 0.0, 1.1, 1.99})
            EXPECT_NEAR(down_m(x, y), 10.0 - 0.25 * (x + 4.0), 2e-5) << x << ' ' << y;
    }
    EXPECT_EQ(down_m(4.01, 0), nothing);
    EXPECT_EQ(down_m(0, 2.01), nothing);
    // Level beams meet z = (x + 4) / 4 where it is as high as they are.
    for (double z = 0.05; z < 1.95; z += 0.15)
        EXPECT_NEAR(range_m({-6, 0.3, z}, {1, 0, 0}), 2.0 + 4.0 * z, 1e-4) << z;
    // One that goes down and across: 3 + t / sqrt(3) (-1) = (x + t / sqrt(3) + 4) / 4.
    const double t = std::sqrt(3.0) * (3.0 - 0.5) / 1.25;
    EXPECT_NEAR(range_m({-2, -1.5, 3}, glm::normalize(glm::dvec3{1, 1, -1})), t, 1e-4);
}

TEST_P(SdfHeightmap, TheTopRowIsInTheNorth) {
    const auto corner = [](std::size_t at_row, std::size_t at_column) {
        return png(3, 1, greys(3, [=](auto row, auto column) {
                       return row == at_row && column == at_column ? 255 : 0;
                   }));
    };
    load_terrain(corner(0, 0), heightmap("4 4 3"));
    EXPECT_NEAR(down_m(-1.9999, 1.9999), 7.0, 1e-3);
    EXPECT_NEAR(down_m(1.9999, 1.9999), 10.0, 1e-3);
    EXPECT_NEAR(down_m(-1.9999, -1.9999), 10.0, 1e-3);
    load_terrain(corner(2, 1), heightmap("4 4 3"));
    EXPECT_NEAR(down_m(0.0001, -1.9999), 7.0, 1e-3);
    EXPECT_NEAR(down_m(0.0001, 1.9999), 10.0, 1e-3);
}

TEST_P(SdfHeightmap, AStepIsASlopeOfOnePixel) {
    load_terrain(png(5, 1, greys(5, [](auto, auto column) { return column < 3 ? 0 : 200; })),
                 heightmap("8 8 2"));
    // Pixels lie 2 m apart: 0 up to x = 0, 2 m high from x = 2 on, whatever the brightest grey is.
    EXPECT_NEAR(range_m({-3, 0.3, 1.5}, {1, 0, 0}), 3.0 + 1.5, 1e-5);
    EXPECT_NEAR(down_m(-0.1, 0.7), 10.0, 1e-5);
    EXPECT_NEAR(down_m(2.1, 0.7), 8.0, 1e-5);
    EXPECT_NEAR(down_m(0.5, 0.7), 9.5, 1e-5);
}

TEST_P(SdfHeightmap, LiesAtItsPositionInItsLink) {
    load_terrain(
        png(3, 1, greys(3, [](auto, auto column) { return static_cast<int>(100 * column); })),
        heightmap("2 2 1",
                  "<pos>10 20 0.5</pos><use_terrain_paging>true</use_terrain_paging>"
                  "<texture><diffuse>d.png</diffuse></texture><blend/>"),
        "<pose>100 0 1 0 0 1.5707963267948966</pose>");
    EXPECT_THAT(warnings_, IsEmpty());
    // Its middle is at (-20, 10) of the visual's turn, and east has become north.
    EXPECT_NEAR(down_m(80, 10), 10.0 - 1.5 - 0.5, 1e-5);
    EXPECT_NEAR(down_m(80.7, 10.5), 10.0 - 1.5 - 0.75, 1e-5);
    EXPECT_EQ(down_m(80, 11.01), nothing);
}

TEST_P(SdfHeightmap, SamplingPutsPointsBetweenPixels) {
    // A saddle: 0 in two corners, 1 in the others, so that its middle is at a half.
    const auto saddle =
        png(2, 1, greys(2, [](auto row, auto column) { return row == column ? 0 : 255; }));
    load_terrain(saddle, heightmap("2 2 1"));
    const float in_one_cell = down_m(0.001, -0.001);
    EXPECT_TRUE(std::abs(in_one_cell - 9.0) < 0.01 || std::abs(in_one_cell - 10.0) < 0.01);
    load_terrain(saddle, heightmap("2 2 1", "<sampling>8</sampling>"));
    EXPECT_NEAR(down_m(0.0, 0.0), 9.5, 1e-5);
    // z = (1 + x y) / 2 at the points, each a quarter of a metre from the next.
    EXPECT_NEAR(down_m(0.5, 0.5), 10.0 - 0.625, 1e-5);
    EXPECT_NEAR(down_m(-0.75, 0.5), 10.0 - 0.3125, 1e-5);
}

TEST_P(SdfHeightmap, ASizeBelowNothingTurnsItUpsideDown) {
    load_terrain(png(3, 1, greys(3, [](auto, auto column) { return column < 2 ? 0 : 255; })),
                 heightmap("2 2 -3"));
    EXPECT_NEAR(down_m(-0.5, 0.1), 9.0, 1e-5);
    EXPECT_NEAR(down_m(0.99999, 0.1), 12.0, 1e-3);
}

TEST_P(SdfHeightmap, OfColoursRedCounts) {
    std::vector<int> samples;
    for (int pixel = 0; pixel < 9; ++pixel)
        samples.insert(samples.end(), {pixel % 3 == 2 ? 128 : 0, 40, 30});
    load_terrain(png(3, 3, samples), heightmap("2 2 1"));
    EXPECT_NEAR(down_m(0.5, 0.1), 9.5, 1e-5);
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m::l::v: " + (folder_.path() / "a.png").string() +
                                      ": is coloured; its red channel gives the heights")));
}

TEST_P(SdfHeightmap, WhatGazeboWouldNotShowIsReadWithAWarning) {
    load_terrain(png(3, 1, {0, 0, 0, 255, 255, 255}), heightmap("2 2 1"));
    EXPECT_NEAR(down_m(0.3, 0.5), 9.75, 1e-5);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("has 3 x 2 points; Gazebo shows squares of")));
}

TEST_P(SdfHeightmap, RoughOnesAreSeenAlike) {
    std::mt19937 rng{7};
    std::uniform_int_distribution<int> grey{0, 255};
    std::uniform_real_distribution<double> anywhere{-1.0, 1.0};
    load_terrain(png(33, 1, greys(33, [&](auto, auto) { return grey(rng); })), heightmap("8 8 3"));
    const auto truth = make_backend("reference", scene_);
    int met = 0;
    for (int i = 0; i < 300; ++i) {
        const Pose pose{{5.0 * anywhere(rng), 5.0 * anywhere(rng), 4.0}, {1.0, 0.0, 0.0, 0.0}};
        const glm::vec3 to{glm::normalize(glm::dvec3{anywhere(rng), anywhere(rng), -0.5})};
        const Fan fan{.directions = {&to, 1}, .world_from_sensor = {&pose, 1}};
        Hit hit;
        Hit expected;
        backend_->cast(fan, {&hit, 1});
        truth->cast(fan, {&expected, 1});
        ASSERT_EQ(hit.met(), expected.met()) << i;
        if (!expected.met()) continue;
        ++met;
        EXPECT_NEAR(hit.range_m, expected.range_m, 1e-3) << i;
    }
    EXPECT_GT(met, 100);
}

TEST_P(SdfHeightmap, ABlackOneIsFlat) {
    load_terrain(png(3, 1, greys(3, [](auto, auto) { return 0; })), heightmap("2 2 1"));
    EXPECT_NEAR(down_m(0.3, 0.5), 10.0, 1e-6);
}

TEST_P(SdfHeightmap, IsSeenByCollisionToo) {
    folder_.write("a.png", png(3, 1, greys(3, [](auto, auto) { return 7; })));
    load(
        world("<model name='m'><static>true</static><link name='l'><collision name='c'><geometry>" +
              heightmap("2 2 1") + "</geometry></collision></link></model>"),
        {.geometry = SdfGeometry::collision});
    EXPECT_NEAR(down_m(0.3, 0.5), 9.0, 1e-6);
}

TEST_P(SdfHeightmap, KeepsWithinTheLimitOfTriangles) {
    const auto picture = png(9, 1, greys(9, [](auto, auto) { return 255; }));
    folder_.write("a.png", picture);
    SdfOptions options;
    options.mesh.triangles = 200;
    const auto terrain = [](const std::string& more) {
        return world(model_of(visual("v", heightmap("2 2 1", more)) + visual("w", unit_box)));
    };
    load(terrain("<sampling>2</sampling>"), options);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a <sampling> of 2 would make more than 200")));
    EXPECT_NEAR(down_m(0.9, 0.9), 9.0, 1e-6);
    options.mesh.triangles = 127;
    load(terrain(""), options);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("has 9 x 9 points, which make 128 triangles; at "
                                                 "most 127 are read; scale it down; left out")));
    EXPECT_EQ(scene_->objects.size(), 1U);
}

TEST_P(SdfHeightmap, WhatCannotBeIsLeftOut) {
    folder_.write("dot.png", png(1, 1, {255}));
    folder_.write("text.png", "no picture");
    folder_.write("a.png", png(3, 1, greys(3, [](auto, auto) { return 7; })));
    const auto of = [](const std::string& uri) {
        return "<heightmap><uri>" + uri + "</uri><size>1 1 1</size></heightmap>";
    };
    load(world(model_of(visual("a", of("gone.png")) + visual("b", of("dot.png")) +
                        visual("c", of("text.png")) + visual("d", heightmap("0 1 1")) +
                        visual("e", unit_box))));
    EXPECT_EQ(scene_->objects.size(), 1U);
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("m::l::a: there is no 'gone.png' near"),
                            HasSubstr("dot.png: has 1 x 1 points; a terrain needs two by two"),
                            HasSubstr("text.png: is n"),
                            HasSubstr("a.png: the <size> of a <heightmap> must be above 0")));
}

}  // namespace
}  // namespace scipd::sim
