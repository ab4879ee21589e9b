// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds with the faults that those of public repositories have: scanned all the same, and what is
// left out is told.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class SdfAsFound : public ::testing::Test {
  protected:
    /// The names of all objects.
    std::vector<std::string> objects(const std::string& text) {
        auto loaded = load_scene(folder_.write("a.sdf", text));
        warnings_ = without_folder(std::move(loaded.warnings), folder_);
        scene_ = loaded.scene;
        std::vector<std::string> names;
        for (const Object& object : scene_->objects)
            names.push_back(object.name);
        return names;
    }

    /// That it is scanned without a word, even where every word counts.
    void expect_nothing_to_a_scanner(const std::string& inside) {
        SCOPED_TRACE(inside);
        const std::string text = world("<model name='m'>" + inside + "<link name='l'>" +
                                       visual("v", unit_box) + "</link></model>");
        EXPECT_THAT(objects(text), ElementsAre("m::l::v"));
        EXPECT_THAT(warnings_, IsEmpty());
        EXPECT_NO_THROW(load_scene(folder_.path() / "a.sdf", {.sdf = {.strict = true}}));
    }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
};

// aws-robomaker-small-house-world, -small-warehouse-world, turtlebot3, pr2, husky, SubT robots.
TEST_F(SdfAsFound, whatIsNothingToAScannerMayBeFaulty) {
    const auto link = [](const std::string& inside) {
        return "<link name='k'>" + inside + "</link>";
    };
    const auto inertia = [](const std::string& mass, const std::string& iyy) {
        return "<inertial><mass>" + mass +
               "</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>" + iyy +
               "</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial>";
    };
    expect_nothing_to_a_scanner(link(inertia("1", "9")));
    expect_nothing_to_a_scanner(link(inertia("-1", "1")));
    expect_nothing_to_a_scanner(link(inertia("1", "-1")));
    expect_nothing_to_a_scanner(link("<inertial><pose>a b c 0 0 0</pose></inertial>"));
    expect_nothing_to_a_scanner(link("<sensor name='s' type='no such type'/>"));
    expect_nothing_to_a_scanner(link("<sensor name='s'/><sensor name='s' type='imu'/>"));
    expect_nothing_to_a_scanner(link("<light name='s' type='no such type'/>"));
    expect_nothing_to_a_scanner(link(
        visual("w", "<empty/>", "<material><script><name>Gazebo/Grey</name></script></material>")));
    expect_nothing_to_a_scanner(
        link(visual("w", "<empty/>", "<material><diffuse>red</diffuse></material>")));
    expect_nothing_to_a_scanner(
        link("<collision name='c'><geometry><empty/></geometry><surface><friction><ode><mu>-1</mu>"
             "</ode></friction></surface></collision>" +
             visual("w", "<empty/>")));
    expect_nothing_to_a_scanner(
        "<joint name='j' type='revolute'><parent>l</parent><child>none</child></joint>");
    expect_nothing_to_a_scanner(
        "<joint name='j' type='wheel'><parent>world</parent><child>l</child></joint>");
    expect_nothing_to_a_scanner("<plugin filename='libp.so'><state/><road/></plugin>");
    expect_nothing_to_a_scanner("<model name='nothing'/>");
}

TEST_F(SdfAsFound, whatOnlyLaterVersionsHaveIsNotLookedAt) {
    EXPECT_THAT(objects(world("<model name='m'>\n<later/><link name='l'><auto_inertia/>" +
                              visual("v", "<box><size>1 1 1</size><bevel>1</bevel></box>") +
                              "</link></model><model name='n'>\n<later/><link name='l' color='x'>"
                              "<auto_inertia/></link></model>")),
                ElementsAre("m::l::v"));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfAsFound, theNameOfAScriptCountsWithoutItsUri) {
    objects(world(model_of(
        visual("v", unit_box, "<material><script><name>Gazebo/Wood</name></script></material>"))));
    EXPECT_EQ(scene_->materials.at(scene_->objects.at(0).material).name, "Gazebo/Wood");
}

TEST_F(SdfAsFound, jointsAreFramesWhereSomebodyRefersToThem) {
    EXPECT_THAT(objects(world(
                    "<model name='m'><link name='base'/><link name='arm'><pose relative_to='j'/>" +
                    visual("v", unit_box) +
                    "</link><joint name='j' type='revolute'><pose relative_to='base'>1 2 3 0 0 0"
                    "</pose><parent>base</parent><child>arm</child></joint></model>")),
                ElementsAre("m::arm::v"));
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_EQ(scene_->objects[0].model_from_object.translation_m, glm::dvec3(1, 2, 3));
}

TEST_F(SdfAsFound, newerVersionsAreReadAsFarAsTheyAreKnown) {
    const std::string inside =
        model_of("<pose degrees='true'>0 0 1 0 0 0</pose>" + visual("v", unit_box)) +
        "<wind><linear_velocity>1 0 0</linear_velocity></wind>";
    const auto of_version = [&](const std::string& version) {
        return "<sdf version='" + version + "'><world name='w'>" + inside + "</world></sdf>";
    };
    for (const std::string version : {"1.10", "1.11", "1.12"}) {
        EXPECT_THAT(objects(of_version(version)), ElementsAre("m::l::v")) << version;
        EXPECT_THAT(warnings_, IsEmpty()) << version;
    }
    for (const std::string version : {"1.13", "1.99", "2.0"}) {
        const std::string newer = "a.sdf:1: is of version " + version +
                                  ", which is newer than any known here; it is read as SDF 1.12";
        EXPECT_THAT(objects(of_version(version)), ElementsAre("m::l::v")) << version;
        EXPECT_THAT(warnings_, ElementsAre(newer));
        const auto file = folder_.write("a.sdf", of_version(version));
        EXPECT_THAT(faults_of([&] { load_scene(file, {.sdf = {.strict = true}}); }, folder_),
                    Contains(newer));
    }
}

// As Gazebo Classic saves nested models.
TEST_F(SdfAsFound, namesMayHaveColons) {
    EXPECT_THAT(
        objects("<sdf version='1.6'><world name='w'><model name='m'><pose frame=''>1 0 0 0 0 0"
                "</pose><link name='a::b'><pose frame=''>0 2 0 0 0 0</pose>" +
                visual("c::v", unit_box) +
                "</link><link name='d'/><joint name='e::j' type='fixed'><parent>a::b</parent>"
                "<child>d</child></joint></model></world></sdf>"),
        ElementsAre("m::a::b::c::v"));
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_EQ(scene_->anchor_m, glm::dvec3(1, 2, 0));
    EXPECT_THAT(objects(world("<model name='m::n'><link name='a::b'>" + visual("v", unit_box) +
                              "</link><frame name='f' attached_to='a::b'/><link name='x'>"
                              "<pose relative_to='f'>1 0 0 0 0 0</pose>" +
                              visual("v", unit_box) + "</link></model>")),
                ElementsAre("m::n::a::b::v", "m::n::x::v"));
}

TEST_F(SdfAsFound, whatIsMissingIsLeftOut) {
    EXPECT_THAT(objects(world("<include><uri>model://gone</uri></include>\n" +
                              model_of(visual("a", mesh_of("lost.dae")) + visual("b", unit_box)))),
                ElementsAre("m::l::b"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("a.sdf:4: there is no 'model://gone' near "),
                            HasSubstr("a.sdf:6: m::l::a: there is no 'lost.dae' near ")));
    for (const auto& warning : warnings_)
        EXPECT_THAT(warning, HasSubstr("; left out"));
    EXPECT_THAT(faults_of([&] { load_scene(folder_.path() / "a.sdf", {.sdf = {.strict = true}}); },
                          folder_),
                ElementsAre(HasSubstr("a.sdf:4: there is no 'model://gone' near "),
                            HasSubstr("a.sdf:6: m::l::a: there is no 'lost.dae' near ")));
}

TEST_F(SdfAsFound, namesMayDifferInCase) {
    folder_.write("Models/Crate/Model.config",
                  "<model><name>crate</name><sdf version='1.9'>MODEL.sdf</sdf></model>");
    folder_.write("Models/Crate/model.sdf",
                  sdf("<model name='c'><link name='l'>" + visual("v", mesh_of("meshes/crate.obj")) +
                      "</link></model>"));
    folder_.write("Models/Crate/meshes/Crate.OBJ", triangle_obj);
    EXPECT_THAT(objects(world("<include><uri>models/crate</uri></include>")),
                ElementsAre("c::l::v"));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:4: 'models/crate' is called "),
                                       HasSubstr("a.sdf:4: 'model.config' is called "),
                                       HasSubstr("a.sdf:4: 'MODEL.sdf' is called "),
                                       HasSubstr("model.sdf:3: c::l::v: 'meshes/crate.obj' is "
                                                 "called ")));
}

TEST_F(SdfAsFound, aDownloadIsToldOnceAndNoNameIsCutShort) {
    const std::string model = "https://fuel.gazebosim.org/1.0/nobody-at-all/models/No such model";
    const std::string include = "<include><uri>" + model + "</uri></include>\n";
    const std::string mesh = mesh_of(model + "/tip/files/meshes/a.dae");
    objects(world(include + include +
                  model_of(visual("a", mesh) + visual("b", mesh) + visual("c", unit_box))));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("a.sdf:4: '" + model +
                                      "' has not been downloaded; fetch it with `gz fuel download "
                                      "-u '" +
                                      model + "'`"),
                            HasSubstr("a.sdf:7: m::l::a: '" + model + "/tip/files/meshes/a.dae'")));
    const std::string name = "model://fetch_description_of_nobody/meshes/base_link_collision.dae";
    objects(world(model_of(visual("a", mesh_of(name)) + visual("c", unit_box))));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("there is no '" + name + "' near ")));
    objects(world(model_of(visual("a", "<mesh/>") + visual("c", unit_box))));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:5: m::l::a: no file is named; left out")));
}

TEST_F(SdfAsFound, aBrokenModelIsLeftOut) {
    folder_.write("b.sdf", "<sdf version='1.9'><model name='b'>\n<link></model></sdf>");
    EXPECT_THAT(
        objects(world("<include><uri>b.sdf</uri></include>" + model_of(visual("v", unit_box)))),
        ElementsAre("m::l::v"));
    EXPECT_THAT(warnings_, ElementsAre("b.sdf:2: is no XML that can be read: an element begins "
                                       "here and has no end, or the end of another one; left out"));
}

// Whatever was taken out before it, and wherever lines end.
TEST_F(SdfAsFound, linesAreThoseOfTheFile) {
    objects(
        world("<!-- two\nlines --><gui>\n<camera name='c'/>\n</gui>\n<model\n name='m'\n "
              "canonical_link='l'>\n<static>true\n</static><link name='l'>" +
              visual("v", unit_box) + "<sensor\nname='s' type='ray'/>\n" +
              visual("far", unit_box, "\n<pose>3e8 0\n 0 0 0 0</pose>") + "</link></model>\n" +
              "<include><uri>\ngone\n</uri></include>\n<population name='p'/>"));
    EXPECT_THAT(warnings_,
                ElementsAre(HasSubstr("a.sdf:13: sensor 's' of link 'l' of model 'm': has neither"),
                            HasSubstr("a.sdf:19: there is no 'gone' near"),
                            HasSubstr("a.sdf:22: p: has no <model>"),
                            HasSubstr("a.sdf:15: m::l::far: lies at")));
}

TEST_F(SdfAsFound, anEmptyWorldIsOne) {
    EXPECT_THAT(objects(world("")), IsEmpty());
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf: holds nothing that a scanner could see")));
}

/// Back where it was when it ends.
class WorkingDirectory {
  public:
    explicit WorkingDirectory(const std::filesystem::path& there) {
        std::filesystem::current_path(there);
    }
    ~WorkingDirectory() { std::filesystem::current_path(before_); }
    WorkingDirectory(const WorkingDirectory&) = delete;
    WorkingDirectory& operator=(const WorkingDirectory&) = delete;

  private:
    std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_F(SdfAsFound, aWorldIsTheSameWhereverScipdIsStarted) {
    const std::string config = "<model><name>m</name><sdf version='1.9'>model.sdf</sdf></model>";
    const auto model = [](const std::string& name) {
        return sdf("<model name='" + name + "'><link name='l'>" + visual("v", unit_box) +
                   "</link></model>");
    };
    folder_.write("m/model.config", config);
    folder_.write("m/model.sdf", model("right"));
    for (const std::string number : {"0", "1", "2"}) {
        folder_.write("other/" + number + "/model.config", config);
        folder_.write("other/" + number + "/model.sdf", model("wrong"));
    }
    const WorkingDirectory other{folder_.path() / "other"};
    EXPECT_THAT(objects(world("<include><uri>model://m</uri></include>")),
                ElementsAre("right::l::v"));
}

TEST_F(SdfAsFound, aVisualWithoutAShapeIsToldUnlessItIsMeantSo) {
    EXPECT_THAT(objects(world(model_of(visual("a", unit_box) + "<visual name='b'/>\n" +
                                       visual("c", "") + visual("d", "<empty/>")))),
                ElementsAre("m::l::a"));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("m::l::b: has no <geometry> with a shape"),
                                       HasSubstr("m::l::c: has no <geometry> with a shape")));
}

TEST_F(SdfAsFound, theRootOfOldWorldsIsGazebo) {
    EXPECT_THAT(objects("<gazebo version='1.2'><world name='w'><model name='m'><static>1</static>"
                        "<link name='l'>" +
                        visual("v", unit_box) + "</link></model></world></gazebo>"),
                ElementsAre("m::l::v"));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfAsFound, anIncludeWhoseConfigIsNoneIsLeftOutAlone) {
    folder_.write("m/model.config", std::string(std::size_t{2} << 20U, ' '));
    EXPECT_THAT(
        objects(world("<include><uri>model://m</uri></include>" + model_of(visual("v", unit_box)))),
        ElementsAre("m::l::v"));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("a.sdf:4: m/model.config: is larger than 1 MiB")));
}

TEST_F(SdfAsFound, ofManyMeshesTheBrokenOnesAloneAreLeftOut) {
    folder_.write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n");
    folder_.write("late.stl", "solid cut short");
    std::string visuals;
    for (int i = 0; i < 40; ++i) {
        const std::string name = "thing_" + std::to_string(i);
        folder_.write(name + ".obj", triangle_obj);
        visuals += visual(name, mesh_of(name + ".obj"));
    }
    visuals += visual("b", mesh_of("broken.obj")) + visual("l", mesh_of("late.stl"));
    EXPECT_EQ(objects(world(model_of(visuals))).size(), 40U);
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("broken.obj: cannot be read as a mesh"),
                                       HasSubstr("late.stl: ")));
}

// aws-robomaker-bookstore-world.
TEST_F(SdfAsFound, aBookThatLiesFarUpIsToldAndCostsTheShopNothing) {
    const auto thing = [](const std::string& name, const std::string& at) {
        return "<model name='" + name + "'><static>1</static><pose>" + at +
               " 0 0 0</pose><link name='l'>" + visual("v", unit_box) + "</link></model>";
    };
    const std::string shop = thing("a", "2 0 0") + thing("b", "-2 0 0") + thing("c", "0 4 0");
    objects(world(shop));
    const glm::dvec3 alone = scene_->anchor_m;
    EXPECT_THAT(warnings_, IsEmpty());
    objects(world(shop + thing("box", "0 0 10000") + thing("book", "0 0 343000")));
    EXPECT_EQ(scene_->anchor_m, alone);
    EXPECT_THAT(warnings_,
                ElementsAre("a.sdf: book::l::v reaches 343000 m from (0 2 0), where most of the "
                            "world lies; ranges out there may be wrong by 31 mm, within 1 km of "
                            "that point by less than 0.1 mm"));
    const std::vector<std::pair<std::string, std::string>> figures{
        {"9e3", "0.98"}, {"4e4", "3.9"}, {"-2.5e6", "250"}, {"9e6", "1000"}};
    for (const auto& [height_m, error_mm] : figures) {
        objects(world(shop + thing("book", "0 0 " + height_m)));
        EXPECT_THAT(warnings_, ElementsAre(HasSubstr("wrong by " + error_mm + " mm, within")));
    }
}

}  // namespace
}  // namespace scipd::sim
