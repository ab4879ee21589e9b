// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Worlds as Gazebo's users write them, small enough to know every range by hand: includes, nested
// models, frames, both kinds of geometry and every shape, seen by the reference backend.
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr auto pi = std::numbers::pi;
constexpr auto nothing = std::numeric_limits<float>::infinity();

class SdfWorld : public ::testing::Test {
  protected:
    void load(const std::string& text, const SdfOptions& options = {}) {
        auto loaded = load_sdf(folder_.write("worlds/a.sdf", text), options);
        scene_ = std::move(loaded.scene);
        warnings_ = std::move(loaded.warnings);
        backend_ = make_backend("reference", scene_);
    }

    Hit look(const glm::dvec3& from, const glm::dvec3& along) {
        const glm::vec3 direction{along};
        const Pose pose{from, {1.0, 0.0, 0.0, 0.0}};
        Hit hit;
        backend_->cast({.directions = {&direction, 1}, .world_from_sensor = {&pose, 1}}, {&hit, 1});
        return hit;
    }

    float range_m(const glm::dvec3& from, const glm::dvec3& along) {
        return look(from, along).range_m;
    }

    std::string seen(const glm::dvec3& from, const glm::dvec3& along) {
        const Hit hit = look(from, along);
        return hit.met() ? scene_->objects[hit.object].name : "nothing";
    }

    /// models/NAME with its model.config, as Gazebo keeps models.
    void write_model(const std::string& name, const std::string& inside) {
        folder_.write(
            "models/" + name + "/model.config",
            "<?xml version='1.0'?><model><name>" + name +
                "</name><version>1.0</version><sdf version='1.9'>model.sdf</sdf></model>");
        folder_.write("models/" + name + "/model.sdf",
                      sdf("<model name='" + name + "'>" + inside + "</model>"));
    }

    std::string place() const { return (folder_.path() / "worlds/a.sdf").string(); }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
    std::unique_ptr<RangeBackend> backend_;
};

/// A cube of 1 m around the origin of its link.
std::string cube_link(const std::string& more = {}) {
    return "<link name='l'>" + more + visual("v", unit_box) + "</link>";
}

// As the control API could not name them.
TEST_F(SdfWorld, ShortensNamesThatAreTooLong) {
    const std::string longest(16'000, 'n');
    const auto model = [](const std::string& name, const std::string& inside) {
        return "<model name='" + name + "'>" + inside + "</model>";
    };
    const std::string link =
        "<link name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry>"
        "</visual></link>";
    load("<sdf version='1.9'><world name='w'>" +
         model(longest + "1",
               "<static>true</static>" + link + model("inner", "<static>false</static>" + link)) +
         model(longest + "2", link) + "</world></sdf>");
    ASSERT_EQ(scene_->models.size(), 3U);
    const std::string& outer = scene_->models[0].name;
    EXPECT_EQ(outer.size(), 64U);
    EXPECT_EQ(scene_->models[1].name, outer + "::inner");
    EXPECT_EQ(scene_->models[2].name.size(), 64U);
    EXPECT_NE(scene_->models[2].name, outer);
    EXPECT_THAT(warnings_, testing::Contains(HasSubstr(outer)));
    EXPECT_EQ(without_model(*scene_, outer)->models.size(), 1U);
}

TEST_F(SdfWorld, IncludesMayBeRenamedMovedAndPinned) {
    write_model("crate", "<pose>0 0 50 0 0 0</pose>" + cube_link());
    load(
        world("<include><uri>model://crate</uri><pose>3 0 0 0 0 0</pose></include>"
              "<include><uri>model://crate</uri><name>left</name><pose>0 5 0 0 0 0</pose>"
              "<static>true</static></include>"
              "<include><uri>../models/crate</uri><name>rear</name>"
              "<pose>-7 0 0 0 0 0.7853981633974483</pose></include>"));
    EXPECT_THAT(warnings_, IsEmpty());
    ASSERT_EQ(scene_->models.size(), 3U);
    EXPECT_EQ(scene_->models[0].name, "crate");
    EXPECT_TRUE(scene_->models[0].movable);
    EXPECT_EQ(scene_->models[1].name, "left");
    EXPECT_FALSE(scene_->models[1].movable);
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 2.5, 1e-6);
    EXPECT_NEAR(range_m({}, {0, 1, 0}), 4.5, 1e-6);
    // A corner of the third looks at us.
    EXPECT_NEAR(range_m({}, {-1, 0, 0}), 7.0 - std::numbers::sqrt2 / 2.0, 1e-6);
}

TEST_F(SdfWorld, IncludesMayIncludeInTurn) {
    write_model("crate", cube_link());
    write_model("stack",
                "<include><uri>model://crate</uri><name>low</name></include>"
                "<include><uri>model://crate</uri><name>high</name>"
                "<pose>0.25 0 1 0 0 0</pose></include>");
    write_model("store",
                "<static>true</static><include><uri>model://stack</uri><name>s</name>"
                "<pose>4 0 0 0 0 0</pose></include>");
    load(world("<include><uri>model://store</uri><pose>1 0 0 0 0 0</pose></include>"));
    ASSERT_EQ(scene_->models.size(), 1U);
    EXPECT_FALSE(scene_->models[0].movable);
    EXPECT_EQ(seen({0, 0, 0}, {1, 0, 0}), "store::s::low::l::v");
    EXPECT_EQ(seen({0, 0, 1}, {1, 0, 0}), "store::s::high::l::v");
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 4.5, 1e-6);
    EXPECT_NEAR(range_m({0, 0, 1}, {1, 0, 0}), 4.75, 1e-6);
}

TEST_F(SdfWorld, MergedIncludesAreLinksOfTheirParent) {
    write_model("crate", cube_link());
    load(
        world("<model name='m'><include merge='true'><uri>model://crate</uri>"
              "<pose>2 0 0 0 0 0</pose></include></model>"));
    EXPECT_EQ(seen({}, {1, 0, 0}), "m::l::v");
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 1.5, 1e-6);
}

TEST_F(SdfWorld, ADoorInAHouseMovesIfItSaysSo) {
    const std::string door = "<model name='door'><static>false</static><pose>0 0 1 0 0 0</pose>" +
                             cube_link() + "</model>";
    const std::string shelf =
        "<model name='shelf'><pose>0 3 0 0 0 0</pose>" + cube_link() + "</model>";
    load(
        world("<model name='house'><static>true</static><pose>5 0 0 0 0 1.5707963267948966</pose>" +
              cube_link() + "<model name='room'>" + door + "</model>" + shelf + "</model>"));
    ASSERT_EQ(scene_->models.size(), 2U);
    EXPECT_EQ(scene_->models[0].name, "house");
    EXPECT_FALSE(scene_->models[0].movable);
    EXPECT_EQ(scene_->models[1].name, "house::room::door");
    EXPECT_TRUE(scene_->models[1].movable);
    EXPECT_EQ(scene_->models[1].world_from_model.translation_m, (glm::dvec3{5.0, 0.0, 1.0}));
    EXPECT_EQ(seen({0, 0, 1}, {1, 0, 0}), "house::room::door::l::v");
    // The house is turned to the left, what lies 3 m to its left is towards us.
    EXPECT_EQ(seen({0, 0, 0}, {1, 0, 0}), "house::shelf::l::v");
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 1.5, 1e-6);
    backend_->move(1, pose_from_rpy({9.0, 0.0, 1.0}, {0.0, 0.0, 0.0}));
    EXPECT_NEAR(range_m({0, 0, 1}, {1, 0, 0}), 8.5, 1e-6);
    EXPECT_NEAR(range_m({0, 0, 0}, {1, 0, 0}), 1.5, 1e-6);
}

TEST_F(SdfWorld, FramesMayBeAttachedToOthers) {
    load(
        world("<frame name='yard'><pose>10 0 0 0 0 1.5707963267948966</pose></frame>"
              "<frame name='gate' attached_to='yard'><pose>2 0 0 0 0 0</pose></frame>"
              "<model name='a'><pose relative_to='gate'>1 0 0 0 0 0</pose>" +
              cube_link() +
              "<frame name='top' attached_to='l'><pose>0 0 2 0 0 0</pose></frame></model>"
              "<model name='b'><pose relative_to='a::top'>0 0 1 0 0 0</pose>" +
              cube_link() + "</model>"));
    // (10, 0) and 3 m along the yard's x, which is W's y.
    EXPECT_EQ(seen({0, 3, 0}, {1, 0, 0}), "a::l::v");
    EXPECT_NEAR(range_m({0, 3, 0}, {1, 0, 0}), 9.5, 1e-6);
    EXPECT_EQ(seen({0, 3, 3}, {1, 0, 0}), "b::l::v");
    EXPECT_NEAR(range_m({0, 3, 3}, {1, 0, 0}), 9.5, 1e-6);
}

TEST_F(SdfWorld, PlacementFramesAreWhereThePoseIs) {
    const std::string inside = "<frame name='front'><pose>2 0 0 0 0 0</pose></frame>" + cube_link();
    write_model("crate", inside);
    load(world("<model name='a' placement_frame='front'><pose>10 0 0 0 0 0</pose>" + inside +
               "</model><include><uri>model://crate</uri><placement_frame>front</placement_frame>"
               "<pose>0 10 0 0 0 1.5707963267948966</pose></include>"));
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 8.0 - 0.5, 1e-6);
    EXPECT_NEAR(range_m({}, {0, 1, 0}), 8.0 - 0.5, 1e-6);
    EXPECT_NEAR(scene_->models[0].world_from_model.translation_m.x, 8.0, 1e-9);
}

TEST_F(SdfWorld, LinksLieWhereTheirJointsAreAtZero) {
    load(
        world("<model name='gate'><link name='post'/><link name='bar'>"
              "<pose relative_to='hinge'>2 0 0 0 0 0</pose>" +
              visual("v", unit_box) +
              "</link><joint name='hinge' type='revolute'><pose relative_to='post'>0 0 1 0 0 "
              "1.5707963267948966</pose><parent>post</parent><child>bar</child>"
              "<axis><xyz>0 0 1</xyz></axis></joint></model>"));
    EXPECT_NEAR(range_m({0, 0, 1}, {0, 1, 0}), 1.5, 1e-6);
}

TEST_F(SdfWorld, EitherTheVisualsOrTheCollisionsAreSeen) {
    const std::string text = world(
        "<model name='m'><static>true</static><pose>5 0 0 0 0 0</pose><link name='l'>" +
        visual("fine", unit_box) +
        "<collision name='coarse'><scipd:material>foam</scipd:material><laser_retro>7</laser_retro>"
        "<geometry><box><size>4 4 4</size></box></geometry></collision></link></model>");
    load(text);
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 4.5, 1e-6);
    EXPECT_EQ(scene_->materials.at(look({}, {1, 0, 0}).material), (Material{"default", 7.0}));
    load(text, {.geometry = SdfGeometry::collision});
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 3.0, 1e-6);
    EXPECT_EQ(seen({}, {1, 0, 0}), "m::l::coarse");
    EXPECT_EQ(scene_->materials.at(look({}, {1, 0, 0}).material), (Material{"foam", 7.0}));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfWorld, WhatIsOnlyOfTheOtherKindIsToldOf) {
    const std::string text = world(model_of(visual("v", unit_box)) +
                                   "<model name='n'><link name='l'><collision name='c'><geometry>" +
                                   unit_box + "</geometry></collision></link></model>");
    load(text);
    EXPECT_THAT(warnings_, ElementsAre(place() + ":7: n::l has collisions but no visual; scanners "
                                                 "see visuals only; with geometry: collision or "
                                                 "--geometry collision they see collisions only"));
    load(text, {.geometry = SdfGeometry::collision});
    EXPECT_THAT(warnings_, ElementsAre(place() + ":4: m::l has visuals but no collision; scanners "
                                                 "see collisions only"));
}

TEST_F(SdfWorld, LaserRetroBelongsToTheMaterial) {
    const std::string oak = "<scipd:material>oak</scipd:material>";
    const auto retro = [](const std::string& value) {
        return "<laser_retro>" + value + "</laser_retro>";
    };
    load(world(model_of(visual("a", unit_box, oak) + visual("b", unit_box, oak + retro("2.5")) +
                        visual("c", unit_box, oak + retro("2.5")) +
                        visual("d", unit_box, oak + retro("0")) +
                        visual("e", unit_box, retro("2.5")))));
    EXPECT_THAT(scene_->materials,
                ElementsAre(Material{"default"}, Material{"oak"}, Material{"oak", 2.5},
                            Material{"oak", 0.0}, Material{"default", 2.5}));
    std::vector<MaterialId> ids;
    for (const Object& object : scene_->objects)
        ids.push_back(object.material);
    EXPECT_THAT(ids, ElementsAre(1, 2, 2, 3, 4));
}

TEST_F(SdfWorld, CollisionsThatDisagreeSayNothingOfTheVisual) {
    const auto collision = [](const std::string& name, const std::string& retro) {
        return "<collision name='" + name + "'><laser_retro>" + retro +
               "</laser_retro><geometry><box><size>1 1 1</size></box></geometry></collision>";
    };
    load(world(model_of(visual("v", unit_box) + collision("a", "1") + collision("b", "2"))));
    EXPECT_EQ(scene_->materials, std::vector{Material{"default"}});
}

TEST_F(SdfWorld, EveryShapeIsWhereItsFormulaSays) {
    const auto at_5 = [](const std::string& name, double y, const std::string& geometry) {
        return visual(name, geometry, "<pose>5 " + std::to_string(y) + " 0 0 0 0</pose>");
    };
    const std::string l_shape =
        "<polyline><point>0 0</point><point>2 0</point><point>2 1</point><point>1 1</point>"
        "<point>1 3</point><point>0 3</point><height>2</height></polyline>";
    load(world(model_of(
        at_5("box", 0, "<box><size>1 1 1</size></box>") +
        at_5("cylinder", 10, "<cylinder><radius>0.5</radius><length>2</length></cylinder>") +
        at_5("sphere", 20, "<sphere><radius>0.5</radius></sphere>") +
        at_5("capsule", 30, "<capsule><radius>0.5</radius><length>2</length></capsule>") +
        at_5("ellipsoid", 40, "<ellipsoid><radii>0.5 1 2</radii></ellipsoid>") +
        at_5("polyline", 50, l_shape) +
        at_5("plane", 70, "<plane><normal>1 0 0</normal><size>2 2</size></plane>"))));
    EXPECT_THAT(warnings_, IsEmpty());
    const auto forward = [&](double y, double z) { return range_m({0, y, z}, {1, 0, 0}); };
    EXPECT_NEAR(forward(0.4, 0.4), 4.5, 1e-6);
    EXPECT_NEAR(forward(10.3, 0.9), 5.0 - 0.4, 1e-6);
    EXPECT_NEAR(forward(20, 0.3), 5.0 - 0.4, 1e-6);
    // Straight at half height, round above it.
    EXPECT_NEAR(forward(30, 0.9), 4.5, 2e-4);
    EXPECT_NEAR(forward(30, 1.3), 5.0 - 0.4, 2e-4);
    EXPECT_EQ(forward(30, 1.6), nothing);
    EXPECT_NEAR(forward(40.6, 0), 5.0 - 0.4, 2e-4);
    EXPECT_NEAR(forward(40, 1.6), 5.0 - 0.3, 2e-4);
    // An L with its corner at the origin of its frame, standing on z = 0.
    EXPECT_NEAR(forward(50.5, 1), 5.0, 1e-6);
    EXPECT_NEAR(range_m({9, 50.5, 1}, {-1, 0, 0}), 2.0, 1e-6);
    EXPECT_NEAR(range_m({9, 52.5, 1}, {-1, 0, 0}), 3.0, 1e-6);
    EXPECT_EQ(forward(50.5, -0.1), nothing);
    EXPECT_NEAR(range_m({5.5, 52, 5}, {0, 0, -1}), 3.0, 1e-6);
    EXPECT_EQ(range_m({6.5, 52, 5}, {0, 0, -1}), nothing);
    EXPECT_NEAR(forward(70.9, 0.9), 5.0, 1e-6);
    EXPECT_EQ(forward(71.1, 0), nothing);
}

TEST_F(SdfWorld, PolylinesWithinEachOtherAreHoles) {
    const auto ring = [](double half) {
        std::string text = "<polyline>";
        for (const auto& [x, y] : {std::pair{-half, -half},
                                   {half, -half},
                                   {half, half},
                                   {-half, half},
                                   {-half, -half}}) {
            text += "<point>" + std::to_string(x) + ' ' + std::to_string(y) + "</point>";
        }
        return text + "<height>1</height></polyline>";
    };
    load(world(model_of(visual("v", ring(2) + ring(1)))));
    EXPECT_NEAR(range_m({-5, 0, 0.5}, {1, 0, 0}), 3.0, 1e-6);
    EXPECT_NEAR(range_m({0, 0, 0.5}, {1, 0, 0}), 1.0, 1e-6);
    EXPECT_EQ(range_m({0, 0, 5}, {0, 0, -1}), nothing);
    EXPECT_NEAR(range_m({1.5, 0, 5}, {0, 0, -1}), 4.0, 1e-6);
}

TEST_F(SdfWorld, WhatIsNothingToAScannerIsIgnoredInSilence) {
    load(
        world("<physics name='p' type='ode'><max_step_size>0.001</max_step_size></physics>"
              "<plugin name='p' filename='libp.so'><anything><at all='1'/></anything></plugin>"
              "<light name='sun' type='directional'><cast_shadows>true</cast_shadows>"
              "<direction>0 0 -1</direction></light><gravity>0 0 -9.8</gravity>"
              "<scene><ambient>0.4 0.4 0.4 1</ambient></scene><gui fullscreen='0'/>"
              "<model name='m'><static>true</static><link name='l'><sensor name='s' type='camera'>"
              "<camera><horizontal_fov>1</horizontal_fov></camera></sensor>" +
              visual("v", unit_box) + "</link></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfWorld, WhatAScannerWouldSeeAndCannotBeHadIsNamedWithItsPlace) {
    load(world(model_of(visual("v", unit_box)) +
               "<population name='p'><model name='n'/></population>"));
    EXPECT_THAT(warnings_, ElementsAre(place() + ":7: p: has no <distribution>; left out"));
}

TEST_F(SdfWorld, ScaledMeshesAreScaledAboutTheirOrigin) {
    folder_.write("worlds/wall.obj", "v 1 -1 -1\nv 1 1 -1\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\n");
    load(world(model_of(visual("v", "<mesh><uri>wall.obj</uri><scale>4 1 1</scale></mesh>"))));
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 4.0, 1e-6);
}

TEST_F(SdfWorld, SubmeshesArePickedByNameAndMayBeCentred) {
    folder_.write("worlds/two.obj",
                  "o near\nv 1 -1 -1\nv 1 1 -1\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\n"
                  "o far\nv 3 -1 -1\nv 3 1 -1\nv 3 1 1\nv 3 -1 1\nf 5 6 7 8\n");
    const auto showing = [](const std::string& submesh) {
        return world(model_of(visual(
            "v",
            "<mesh><uri>two.obj</uri><submesh>" + submesh + "</submesh><scale>2 1 1</scale></mesh>",
            "<pose>10 0 0 0 0 0</pose>")));
    };
    load(showing("<name>near</name>"));
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 12.0, 1e-6);
    load(showing("<name>far</name>"));
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 16.0, 1e-6);
    load(showing("<name>far</name><center>true</center>"));
    EXPECT_NEAR(range_m({}, {1, 0, 0}), 10.0, 1e-6);
    const auto faults =
        faults_of([&] { load(showing("<name>none</name>"), {.strict = true}); }, folder_);
    EXPECT_THAT(faults, ElementsAre("worlds/a.sdf:5: m::l::v: worlds/two.obj: has no submesh "
                                    "'none'; there are 'far', 'near', 'two.obj'"));
}

TEST_F(SdfWorld, TextsAreWorldsToo) {
    folder_.write("parts/part.obj", triangle_obj);
    const auto model = "<model name='m'>\n<link name='l'>" + visual("v", mesh_of("part.obj")) +
                       visual("f", "<image><uri>a</uri></image>") + "</link></model>";
    for (const auto& text : {"<?xml version='1.0'?><!-- a < b -->\n" + model, sdf("\n" + model)}) {
        const auto loaded = load_sdf_text(text, "posted", folder_.path() / "parts");
        EXPECT_EQ(loaded.scene->models.at(0).name, "m");
        EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("m::l::f: <image> is not ")));
        EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("posted:")));
    }
}

TEST_F(SdfWorld, ClosedFormOfARoomMadeOfIncludes) {
    write_model("wall", "<static>true</static><link name='l'><pose>0 0 1 0 0 0</pose>" +
                            visual("v", "<box><size>10 0.2 2</size></box>") + "</link>");
    const auto wall = [](const std::string& name, const std::string& pose) {
        return "<include><uri>model://wall</uri><name>" + name + "</name><pose>" + pose +
               "</pose></include>";
    };
    load(world(wall("north", "0 3.1 0 0 0 0") + wall("south", "0 -2.1 0 0 0 0") +
               wall("east", "4.1 0 0 0 0 1.5707963267948966") +
               wall("west", "-4.1 0 0 0 0 -1.5707963267948966")));
    for (int degree = 0; degree < 360; ++degree) {
        const double angle = degree * pi / 180.0;
        const glm::dvec3 along{std::cos(angle), std::sin(angle), 0.0};
        const double x = 4.0 / std::abs(along.x);
        const double y = (along.y > 0 ? 3.0 : 2.0) / std::abs(along.y);
        EXPECT_NEAR(range_m({0, 0, 1}, along), std::min(x, y), 2e-6) << degree;
    }
}

}  // namespace
}  // namespace scipd::sim
