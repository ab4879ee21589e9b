// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Shapes that few readers know, against ranges by hand, with every backend that casts.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/sdf/sdf_cast.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SdfShapes : public SdfCast {};

INSTANTIATE_TEST_SUITE_P(Backends, SdfShapes, ::testing::Values("reference", "embree"),
                         name_of_backend);

TEST_P(SdfShapes, AConeIsWideBelowAndPointedAbove) {
    load("<sdf version='1.11'>" +
         model_of("<visual name='v'><pose>0 0 1 0 0 0</pose><geometry>"
                  "<cone><radius>0.5</radius><length>2</length></cone></geometry></visual>") +
         "</sdf>");
    EXPECT_THAT(warnings_, IsEmpty());
    // Its radius is 0.5 on the ground, 0.25 at half its height and 0 at 2 m.
    EXPECT_NEAR(range_m({-3, 0, 0.001}, {1, 0, 0}), 2.5 + 0.00025, 1.5e-4);
    EXPECT_NEAR(range_m({-3, 0, 1}, {1, 0, 0}), 2.75, 1.5e-4);
    EXPECT_NEAR(range_m({-3, 0, 1.8}, {1, 0, 0}), 2.95, 1.5e-4);
    EXPECT_EQ(range_m({-3, 0, 2.01}, {1, 0, 0}), nothing);
    EXPECT_NEAR(down_m(0.0, 0.0), 8.0, 1e-5);
    EXPECT_NEAR(range_m({0.3, 0, -1}, {0, 0, 1}), 1.0, 1e-5);
    for (double turn_rad = 0.05; turn_rad < 6.2; turn_rad += 0.1) {
        const glm::dvec3 out{std::cos(turn_rad), std::sin(turn_rad), 0.0};
        const glm::dvec3 from = 2.0 * out + glm::dvec3{0, 0, 0.5};
        EXPECT_NEAR(range_m(from, -out), 2.0 - 0.375, 1.5e-4) << turn_rad;
    }
}

TEST_P(SdfShapes, ConesThatCannotBeAreLeftOut) {
    load("<sdf version='1.11'>" +
         model_of(visual("box", unit_box) +
                  visual("flat", "<cone><radius>0</radius><length>2</length></cone>") +
                  visual("odd", "<cone><radius>wide</radius><length>2</length></cone>")) +
         "</sdf>");
    EXPECT_EQ(scene_->objects.size(), 1U);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("m::l::flat: every size must be above 0"),
                                       HasSubstr("m::l::odd: its <radius> 'wide' cannot be read")));
}

TEST_P(SdfShapes, ARoadIsAStripAlongItsPoints) {
    load(
        world("<road name='street'><width>2</width><point>0 0 0.5</point><point>10 0 0.5</point>"
              "<point>10 10 1.5</point><material><script><uri>file://x</uri><name>Asphalt</name>"
              "</script></material></road>"));
    EXPECT_THAT(warnings_, IsEmpty());
    ASSERT_EQ(scene_->models.size(), 1U);
    EXPECT_EQ(scene_->models[0].name, "street");
    EXPECT_FALSE(scene_->models[0].movable);
    EXPECT_EQ(scene_->materials[scene_->objects[0].material].name, "Asphalt");
    EXPECT_NEAR(down_m(5, 0), 9.5, 1e-5);
    EXPECT_NEAR(down_m(5, 0.99), 9.5, 1e-5);
    EXPECT_NEAR(down_m(5, -0.99), 9.5, 1e-5);
    EXPECT_EQ(down_m(5, 1.01), nothing);
    EXPECT_EQ(down_m(5, -1.01), nothing);
    EXPECT_EQ(down_m(-0.01, 0), nothing);
    // The outer corner of the turn belongs to it, the inner one does not.
    EXPECT_LT(down_m(10.9, -0.85), nothing);
    EXPECT_EQ(down_m(8.9, 1.1), nothing);
    EXPECT_LT(down_m(10, 9.9), 8.6);
    EXPECT_EQ(down_m(10, 10.1), nothing);
}

TEST_P(SdfShapes, AreReadStrictlyToo) {
    SdfOptions options;
    options.strict = true;
    load(world(
             "<road name='street'><width>2</width><point>0 0 0</point><point>9 0 0</point></road>" +
             model_of(visual("v", "<cone><radius>1</radius><length>2</length></cone>",
                             "<pose>0 5 1 0 0 0</pose>"))),
         options);
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_NEAR(down_m(5, 0), 10.0, 1e-5);
    EXPECT_NEAR(down_m(0, 5), 8.0, 1e-5);
}

TEST_P(SdfShapes, RoadsFarOutAreAsExactAsAny) {
    load(
        world("<road name='a'><width>3</width><point>700000.25 5000000.5 12.125</point>"
              "<point>700100.25 5000000.5 12.125</point></road>"));
    EXPECT_NEAR(range_m({700050, 5000000.5 + 1.49, 20}, {0, 0, -1}), 7.875, 1e-4);
    EXPECT_EQ(range_m({700050, 5000000.5 + 1.51, 20}, {0, 0, -1}), nothing);
}

TEST_P(SdfShapes, RoadsNeedNoNamesOfTheirOwn) {
    const std::string points = "<point>0 0 0</point><point>1 0 0</point>";
    load(world("<road>" + points + "</road><road name='__default__'>" + points +
               "</road><road name='box'>" + points + "</road><model name='box'><link name='l'>" +
               visual("v", unit_box) + "</link></model>"));
    std::vector<std::string> names;
    for (const Model& model : scene_->models)
        names.push_back(model.name);
    EXPECT_THAT(names, ::testing::UnorderedElementsAre("road", "road_2", "box_2", "box"));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_P(SdfShapes, RoadsThatCannotBeAreLeftOut) {
    load(
        world("<road name='stub'><point>1 2 3</point><point>1 2 3</point></road>\n"
              "<road name='thin'><width>-1</width><point>0 0 0</point><point>1 0 0</point></road>"
              "\n<road name='odd'><point>0 0</point><point>1 0 0</point></road>" +
              model_of(visual("v", unit_box))));
    EXPECT_EQ(scene_->objects.size(), 1U);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a <road> needs two <point>s that differ"),
                                       HasSubstr("the <width> of a <road> must be above 0"),
                                       HasSubstr("its <point> '0 0' cannot be read")));
    EXPECT_THAT(warnings_[1], HasSubstr("thin"));
}

}  // namespace
}  // namespace scipd::sim
