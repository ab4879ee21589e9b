// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What earlier readers refused, lost or misread, against places by hand.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/scene_file.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SdfReading : public ::testing::Test {
  protected:
    void load(const std::string& text, const SdfOptions& options = {}) {
        const auto file = folder_.write("a.sdf", text);
        LoadedScene loaded = load_sdf(file, options);
        scene_ = loaded.scene;
        warnings_ = without_folder(std::move(loaded.warnings), folder_);
    }

    /// Where a part is in the world.
    [[nodiscard]] glm::dvec3 at_m(const std::string& name) const {
        for (const Object& object : scene_->objects) {
            if (object.name != name) continue;
            return scene_->models[object.model].world_from_model *
                   object.model_from_object.translation_m;
        }
        for (const Frame& frame : scene_->frames) {
            if (frame.name != name) continue;
            return scene_->models[frame.model].world_from_model *
                   frame.model_from_frame.translation_m;
        }
        ADD_FAILURE() << "there is no " << name;
        return {};
    }
    void expect_at(const std::string& name, const glm::dvec3& wanted_m) const {
        EXPECT_LT(glm::distance(at_m(name), wanted_m), 1e-9) << name;
    }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
};

std::string boxed_model(const std::string& name, const std::string& pose = {}) {
    return "<model name='" + name + "'>" + pose + "<link name='l'>" + visual("v", unit_box) +
           "</link></model>";
}

TEST_F(SdfReading, TakesNamesThatTheLibraryKeepsForItself) {
    load(sdf("<world name='world'>" + boxed_model("__x__", "<pose>1 0 0 0 0 0</pose>") +
             "<model name='world'><pose relative_to='__x__'>0 2 0 0 0 0</pose><link name='world'>" +
             visual("v", unit_box) + "</link></model></world>"));
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_EQ(scene_->name, "world");
    expect_at("__x__::l::v", {1, 0, 0});
    expect_at("world::world::v", {1, 2, 0});
}

TEST_F(SdfReading, MovesAModelOfALongNameToWhereItWasSaved) {
    const std::string name(100, 'n');
    load(world(boxed_model(name) + "<state world_name='w'><model name='" + name +
               "'><pose>7 8 9 0 0 0</pose><link name='l'><pose>7 8 9.5 0 0 0</pose></link></model>"
               "</state>"));
    ASSERT_EQ(scene_->models.size(), 1U);
    EXPECT_EQ(scene_->models[0].world_from_model.translation_m, glm::dvec3(7, 8, 9));
    expect_at(scene_->objects[0].name, {7, 8, 9.5});
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("the name has more than 64 bytes")));
}

TEST_F(SdfReading, PlacesModelsByJointsAndNestedNames) {
    const std::string inside =
        "<link name='l'>" + visual("v", unit_box) + "</link><link name='arm'><pose>0 0 2 0 0 0" +
        "</pose></link><joint name='j' type='revolute'><pose>0 1 0 0 0 0</pose><parent>l</parent>"
        "<child>arm</child></joint>";
    load(world("<model name='a' placement_frame='j'><pose>10 0 0 0 0 0</pose>" + inside +
               "</model><model name='b' placement_frame='n::j'><pose>20 0 0 0 0 0</pose>"
               "<model name='n'><pose>0 0 5 0 0 0</pose>" +
               inside + "</model></model>" +
               "<model name='c'><pose relative_to='b::n::arm'>1 0 0 0 0 0</pose><link name='l'>" +
               visual("v", unit_box) + "</link></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
    expect_at("a::l::v", {10, -1, -2});
    expect_at("b::n::l::v", {20, -1, -2});
    expect_at("c::l::v", {21, -1, 0});
}

TEST_F(SdfReading, MergesIntoAWorld) {
    folder_.write("room.sdf", sdf("<world name='other'>" + boxed_model("wall") + "</world>"));
    folder_.write("pair.sdf",
                  sdf("<model name='pair'><frame name='f'><pose>0 1 0 0 0 0</pose></frame>" +
                      boxed_model("one", "<pose relative_to='f'>0 0 3 0 0 0</pose>") +
                      boxed_model("two") + "</model>"));
    load(
        world("<include merge='true'><uri>room.sdf</uri></include>"
              "<include merge='true'><uri>pair.sdf</uri><pose>5 0 0 0 0 0</pose></include>"));
    EXPECT_THAT(warnings_, IsEmpty());
    expect_at("wall::l::v", {0, 0, 0});
    expect_at("one::l::v", {5, 1, 3});
    expect_at("two::l::v", {5, 0, 0});
}

TEST_F(SdfReading, ChangesWhatAnIncludeBringsAndKeepsTheRest) {
    folder_.write("m.sdf", sdf("<model name='m'><link name='l'><pose>1 0 0 0 0 0</pose>" +
                               visual("v", unit_box) + visual("w", unit_box) + "</link></model>"));
    const auto with = [&](const std::string& params) {
        load(world("<include><uri>m.sdf</uri><experimental:params>\n" + params +
                   "</experimental:params></include>"));
    };
    with(
        "<link element_id='l' action='modify'><pose>4 0 0 0 0 0</pose></link>"
        "<visual element_id='l::w' action='remove'/>"
        "<visual element_id='l::x' action='add'><pose>0 0 1 0 0 0</pose><geometry>" +
        unit_box + "</geometry></visual>");
    EXPECT_THAT(warnings_, IsEmpty());
    ASSERT_EQ(scene_->objects.size(), 2U);
    expect_at("m::l::v", {4, 0, 0});
    expect_at("m::l::x", {4, 0, 1});
    with(
        "<visual element_id='l::v'><geometry action='replace'><sphere><radius>2</radius></sphere>"
        "</geometry></visual>");
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_TRUE(std::ranges::any_of(scene_->objects, [](const Object& object) {
        return object.name == "m::l::v" && std::holds_alternative<Sphere>(object.shape);
    }));
    with(
        "<visual element_id='l::gone' action='remove'/>\n"
        "<link element_id='l' name='other' action='modify'><pose>2 0 0 0 0 0</pose></link>");
    EXPECT_THAT(warnings_,
                ElementsAre("a.sdf:5: <visual> of experimental:params: the model has no <visual> "
                            "'l::gone'; skipped",
                            "a.sdf:6: <link> of experimental:params: cannot rename it to 'other'; "
                            "skipped"));
    expect_at("m::l::v", {2, 0, 0});
}

// As libsdformat does: the id is that of the element around the new one.
TEST_F(SdfReading, AddsWhatAnIncludeNamesToWhatItsIdSays) {
    folder_.write("m.sdf", sdf("<model name='m'><link name='l'><pose>1 0 0 0 0 0</pose>" +
                               visual("v", unit_box) + "</link></model>"));
    const std::string shape = "<geometry>" + unit_box + "</geometry>";
    load(
        world("<include><uri>m.sdf</uri><experimental:params>\n"
              "<visual element_id='l' action='add' name='w'><pose>0 0 2 0 0 0</pose>" +
              shape + "</visual><link element_id='' action='add' name='k'><visual name='v'>" +
              shape + "</visual></link>\n<visual element_id='none' action='add' name='x'>" + shape +
              "</visual></experimental:params></include>"));
    EXPECT_THAT(warnings_, ElementsAre("a.sdf:6: <visual> of experimental:params: the model has no "
                                       "'none'; skipped"));
    ASSERT_EQ(scene_->objects.size(), 3U);
    expect_at("m::l::w", {1, 0, 2});
    expect_at("m::k::v", {0, 0, 0});
}

// Else a scanner would see it elsewhere.
TEST_F(SdfReading, LeavesOutWhatSaysItsAnglesInAWayThatNobodyKnows) {
    load(world(boxed_model("a", "<pose degrees='maybe'>0 0 0 0 0 90</pose>") +
               boxed_model("b", "<pose rotation_format='foo'>0 0 0 0 0 1</pose>") +
               boxed_model("c",
                           "<pose degrees='true' rotation_format='euler_rpy'>1 0 0 0 0 90"
                           "</pose>")));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("degrees 'maybe', which must be true or false; left out"),
                            HasSubstr("'foo', which must be euler_rpy or quat_xyzw; left out")));
    expect_at("c::l::v", {1, 0, 0});
}

// Nothing of it would be seen, or not what was meant.
TEST_F(SdfReading, LeavesOutWhatHasNoDirectionOrNoArea) {
    folder_.write("m.stl", "solid\nendsolid\n");
    load(world(boxed_model("ok") + "<model name='m'><link name='l'>" +
               visual("p", "<plane><normal>0 0 0</normal></plane>") +
               visual("q",
                      "<polyline><point>0.1 0.1</point><point>0.2 0.2</point><point>0.3 0.3</point>"
                      "</polyline>") +
               visual("r", "<mesh><uri>m.stl</uri><scale>1 0 1</scale></mesh>") +
               "</link></model><actor/>"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("an <actor> that holds nothing is nobody; left out"),
                            HasSubstr("m::l::p: its <normal> is 0 0 0, which is no direction"),
                            HasSubstr("m::l::q: all <point>s of a <polyline> lie on one line"),
                            HasSubstr("m::l::r: its <scale> has a 0, which leaves nothing")));
    EXPECT_EQ(scene_->objects.size(), 1U);
}

TEST_F(SdfReading, FollowsReferencesHoweverManyThereAre) {
    constexpr int count = 30'000;
    std::string frames;
    for (int i = 0; i < count; ++i) {
        frames += "<frame name='f" + std::to_string(i) + "'><pose relative_to='f" +
                  std::to_string(i + 1) + "'>1 0 0 0 0 0</pose></frame>";
    }
    frames += "<frame name='f" + std::to_string(count) + "'/>";
    load(world("<model name='m'>" + frames + "<link name='l'><pose relative_to='f0'/>" +
               visual("v", unit_box) + "</link></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
    expect_at("m::l::v", {count, 0, 0});
}

TEST_F(SdfReading, TellsOfFramesThatLieNowhereInAWorldAsInAModel) {
    const std::string frame = "<frame name='f' attached_to='nowhere'/>";
    load(world(frame + "<model name='m'>" + frame + "<link name='l'>" + visual("v", unit_box) +
               "</link></model>"));
    const std::string why = "f: it is attached to 'nowhere', which is no frame; left out";
    EXPECT_THAT(warnings_,
                testing::UnorderedElementsAre(HasSubstr(": " + why), HasSubstr(": m::" + why)));
}

// A part that was added has the place of the params, and all else its own.
TEST_F(SdfReading, NamesTheLinesOfWhatParamsHaveChanged) {
    folder_.write("m.sdf", sdf("<model name='m'>\n<link name='l'>\n" + visual("u", "<box/>") +
                               visual("v", "<box><size>a</size></box>") + "</link></model>"));
    load(
        world("<include><uri>m.sdf</uri>\n\n<experimental:params>\n"
              "<visual element_id='l' action='add' name='w'><geometry><box><size>b</size></box>"
              "</geometry></visual></experimental:params></include>"));
    ASSERT_EQ(warnings_.size(), 2U);
    EXPECT_THAT(warnings_[0], testing::MatchesRegex("m.sdf:[1-9].*m::l::v: its <size> 'a'.*"));
    EXPECT_THAT(warnings_[1], testing::StartsWith("a.sdf:6: m::l::w: its <size> 'b'"));
}

TEST_F(SdfReading, TakesNamesInTheEncodingThatTheFileDeclares) {
    load("<?xml version='1.0' encoding='ISO-8859-1'?>" +
         world("<model name='Stra\xDF"
               "e'><link name='l'>" +
               visual("v", unit_box) + "</link></model>"));
    ASSERT_EQ(scene_->models.size(), 1U);
    EXPECT_EQ(scene_->models[0].name,
              "Stra\xC3\x9F"
              "e");
}

TEST_F(SdfReading, TakesManyRoadsOfOneName) {
    std::string roads;
    for (int i = 0; i < 20'000; ++i)
        roads += "<road/>";
    const auto begin = std::chrono::steady_clock::now();
    load(world(roads + boxed_model("m")));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    expect_at("m::l::v", {0, 0, 0});
}

TEST_F(SdfReading, OffersALidarOfLessThanOneRow) {
    load(world("<model name='m'><link name='l'>" + visual("v", unit_box) +
               "<sensor name='s' type='ray'><ray><scan><horizontal><samples>10</samples>"
               "<min_angle>-1</min_angle><max_angle>1</max_angle></horizontal><vertical><samples>1"
               "</samples><resolution>0.01</resolution></vertical></scan><range><min>0.1</min>"
               "<max>10</max></range></ray></sensor></link></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
    const auto lidar = std::ranges::find(scene_->frames, "m::l::s", &Frame::name);
    ASSERT_NE(lidar, scene_->frames.end());
    ASSERT_TRUE(lidar->lidar);
    EXPECT_EQ(lidar->lidar->rows, 1);
}

TEST_F(SdfReading, TakesACommentBeforeTheDeclaration) {
    load("<!-- made by hand -->\n<?xml version='1.0'?>\n<sdf version='1.12'>\n" +
         model_of(visual("v", "<box><size>0 1 1</size></box>") + visual("w", unit_box)) + "</sdf>");
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:5: m::l::v: every size")));
}

TEST_F(SdfReading, ReadsValuesInTheAttributesOfSdf1_0) {
    load(
        "<gazebo version='1.0'><world name='w'><model name='m' static='true'><origin "
        "pose='1 2 3 0 0 0'/><link name='l'><visual name='v'><origin pose='0 0 1 0 0 0'/><geometry>"
        "<box size='1 2 3'/></geometry></visual></link></model></world></gazebo>");
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_FALSE(scene_->models[0].movable);
    expect_at("m::l::v", {1, 2, 4});
    EXPECT_EQ(std::get<Box>(scene_->objects[0].shape).size_m, glm::dvec3(1, 2, 3));
}

TEST_F(SdfReading, PutsAGridOfAPopulationAroundItsMiddle) {
    load(world("<population name='p'><model name='m'><pose>9 9 9 0 0 0</pose><link name='l'>" +
               visual("v", unit_box) +
               "</link></model><pose>10 0 0 0 0 0</pose><distribution><type>grid</type><rows>2"
               "</rows><cols>3</cols><step>4 2 0</step></distribution></population>"));
    EXPECT_THAT(warnings_, IsEmpty());
    ASSERT_EQ(scene_->models.size(), 6U);
    expect_at("m_clone_0::l::v", {6, -1, 0});
    expect_at("m_clone_2::l::v", {14, -1, 0});
    expect_at("m_clone_4::l::v", {10, 1, 0});
    const std::string region =
        "<model_count>4</model_count><box><size>8 2 2</size></box><distribution><type>";
    load(world("<population name='p'>" + boxed_model("m") + region +
               "linear-x</type></distribution></population>"));
    expect_at("m_clone_0::l::v", {-4, 0, 0});
    expect_at("m_clone_3::l::v", {2, 0, 0});
    load(world("<population name='p'>" + boxed_model("m") + region +
               "random</type></distribution></population>"));
    for (const Object& object : scene_->objects) {
        const glm::dvec3 at = at_m(object.name);
        EXPECT_TRUE(std::abs(at.x) <= 4 && std::abs(at.y) <= 1 && std::abs(at.z) <= 1);
    }
}

TEST_F(SdfReading, NamesTheVariableOfWhatGazeboClassicFinds) {
    load(world(model_of(visual("v", unit_box) + visual("w", mesh_of("file://media/a.dae")))));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("nor in GAZEBO_RESOURCE_PATH")));
}

TEST_F(SdfReading, WarnsOfAnUnknownScriptAndRefusesNoStrictWorldForIt) {
    const auto named = [&](const std::string& material) {
        const auto file = folder_.write("a.sdf", world(model_of(visual("v", unit_box, material))));
        return load_scene(file, {.sdf = {.strict = true},
                                 .materials = std::make_shared<const MaterialLibrary>()})
            .warnings;
    };
    EXPECT_THAT(named("<material><script><name>Gazebo/None</name></script></material>"),
                ElementsAre(HasSubstr("no library knows the material 'Gazebo/None'")));
    EXPECT_THROW(named("<scipd:material>none</scipd:material>"), LoadError);
}

}  // namespace
}  // namespace scipd::sim
