// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf.h"

#include <cmath>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Sdf : public ::testing::Test {
  protected:
    SharedScene load(const std::string& text) {
        auto loaded = load_sdf(folder_.write("a.sdf", text));
        warnings_ = std::move(loaded.warnings);
        return loaded.scene;
    }

    /// The point p of an object's frame, in W.
    static glm::dvec3 in_world(const Scene& scene, std::size_t object, const glm::dvec3& p) {
        const auto& that = scene.objects.at(object);
        return scene.models.at(that.model).world_from_model * (that.model_from_object * p);
    }

    static std::string material_of(const Scene& scene, std::size_t object) {
        return scene.materials.at(scene.objects.at(object).material).name;
    }

    TempDir folder_;
    std::vector<std::string> warnings_;
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
    EXPECT_NEAR(a.z, b.z, 1e-9);
}

TEST_F(Sdf, everyShapeKeepsItsMeasures) {
    const auto scene = load(world(model_of(
        visual("box", "<box><size>1 2 3</size></box>") +
        visual("cylinder", "<cylinder><radius>0.25</radius><length>2</length></cylinder>") +
        visual("sphere", "<sphere><radius>0.5</radius></sphere>") +
        visual("plane", "<plane><normal>0 0 1</normal><size>4 5</size></plane>"))));
    ASSERT_EQ(scene->objects.size(), 4U);
    EXPECT_EQ(std::get<Box>(scene->objects[0].shape).size_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(std::get<Cylinder>(scene->objects[1].shape).radius_m, 0.25);
    EXPECT_EQ(std::get<Cylinder>(scene->objects[1].shape).length_m, 2.0);
    EXPECT_EQ(std::get<Sphere>(scene->objects[2].shape).radius_m, 0.5);
    EXPECT_EQ(std::get<Plane>(scene->objects[3].shape).size_m, glm::dvec2(4, 5));
    EXPECT_EQ(scene->objects[3].name, "m::l::plane");
    EXPECT_EQ(scene->name, "w");
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(Sdf, posesOfModelLinkAndVisualAddUp) {
    const auto scene = load(world(
        "<model name='m'><pose>10 0 0 0 0 1.5707963267948966</pose><link name='l'>"
        "<pose>0 2 0 0 0 0</pose>" +
        visual("v", unit_box, "<pose>0 0 3 1.5707963267948966 0 0</pose>") + "</link></model>"));
    // The model's quarter turn takes the link's +y to W's -x; the visual's roll takes its z to -y
    // of the link, which is +x of W.
    expect_near(in_world(*scene, 0, {0, 0, 0}), {8, 0, 3});
    expect_near(in_world(*scene, 0, {0, 0, 1}), {9, 0, 3});
    expect_near(in_world(*scene, 0, {1, 0, 0}), {8, 1, 3});
}

TEST_F(Sdf, framesResolveWhateverTheyAreRelativeTo) {
    const auto scene = load(world(
        "<frame name='f'><pose>1 2 3 0 0 1.5707963267948966</pose></frame>"
        "<model name='m'><pose relative_to='f'>1 0 0 0 0 0</pose>"
        "<frame name='up'><pose>0 0 5 0 0 0</pose></frame>"
        "<link name='l'><pose>7 7 7 0 0 0</pose>" +
        visual("v", unit_box, "<pose relative_to='up'>0 0 0.5 0 0 0</pose>") + "</link></model>"));
    expect_near(in_world(*scene, 0, {0, 0, 0}), {1, 3, 8.5});
}

TEST_F(Sdf, anglesMayBeDegrees) {
    const auto scene =
        load(world(model_of(visual("v", unit_box, "<pose degrees='true'>0 0 0 0 0 90</pose>"))));
    expect_near(in_world(*scene, 0, {1, 0, 0}), {0, 1, 0});
}

TEST_F(Sdf, planesFaceTheirNormal) {
    const auto scene =
        load(world(model_of(visual("v", "<plane><normal>1 0 0</normal><size>2 3</size></plane>",
                                   "<pose>0 0 1 0 0 1.5707963267948966</pose>"))));
    // Along x of the visual, and the visual itself is turned to the left.
    expect_near(in_world(*scene, 0, {0, 0, 1}), {0, 1, 1});
}

TEST_F(Sdf, nestedModelsMoveWithTheirTopLevelModel) {
    const auto scene = load(world(
        "<model name='outer'><pose>1 0 0 0 0 0</pose><link name='l'>" + visual("v", unit_box) +
        "</link><model name='inner'><static>true</static><pose>0 1 0 0 0 1.5707963267948966</pose>"
        "<link name='l'><pose>0.5 0 0 0 0 0</pose>" +
        visual("v", unit_box) + "</link></model></model>"));
    ASSERT_EQ(scene->models.size(), 1U);
    EXPECT_EQ(scene->models[0].name, "outer");
    EXPECT_TRUE(scene->models[0].movable);
    ASSERT_EQ(scene->objects.size(), 2U);
    EXPECT_EQ(scene->objects[1].name, "outer::inner::l::v");
    EXPECT_EQ(scene->objects[1].model, 0U);
    expect_near(in_world(*scene, 1, {0, 0, 0}), {1, 1.5, 0});
}

TEST_F(Sdf, onlyStaticModelsStayPut) {
    const auto scene =
        load(world(model_of(visual("v", unit_box)) + "<model name='cart'><link name='l'>" +
                   visual("v", unit_box) + "</link></model>"));
    ASSERT_EQ(scene->models.size(), 2U);
    EXPECT_FALSE(scene->models[0].movable);
    EXPECT_TRUE(scene->models[1].movable);
    EXPECT_EQ(scene->objects[1].model, 1U);
}

TEST_F(Sdf, includesComeFromBesideTheFile) {
    const auto part = sdf("<model name='part'><link name='l'>" + visual("v", mesh_of("part.obj")) +
                          "</link></model>");
    folder_.write("part.sdf", part);
    folder_.write("part.obj", triangle_obj);
    folder_.write("parts/deep/model.sdf", part);
    folder_.write("parts/deep/part.obj", triangle_obj);
    folder_.write("parts/deep/model.config",
                  "<model><name>part</name><version>1.0</version>"
                  "<sdf version='1.9'>model.sdf</sdf></model>");
    const auto scene =
        load(world("<include><uri>part.sdf</uri><pose>1 2 3 0 0 0</pose></include>"
                   "<include><uri>model://parts/deep</uri><name>second</name><static>true</"
                   "static></include>"));
    ASSERT_EQ(scene->models.size(), 2U);
    EXPECT_EQ(scene->models[0].name, "part");
    EXPECT_EQ(scene->models[1].name, "second");
    EXPECT_FALSE(scene->models[1].movable);
    expect_near(in_world(*scene, 0, {0, 0, 0}), {1, 2, 3});
    EXPECT_EQ(std::get<SharedMesh>(scene->objects[1].shape)->triangles.size(), 1U);
}

TEST_F(Sdf, aModelFileIsASceneToo) {
    const auto scene =
        load(sdf("<model name='robot'><pose>1 0 0 0 0 0</pose><link name='l'>" +
                 visual("v", unit_box, "<pose>0 0 2 0 0 0</pose>") + "</link></model>"));
    EXPECT_EQ(scene->name, "robot");
    ASSERT_EQ(scene->models.size(), 1U);
    expect_near(in_world(*scene, 0, {0, 0, 0}), {1, 0, 2});
}

TEST_F(Sdf, readsUrdf) {
    const auto file =
        folder_.write("a.urdf",
                      "<robot name='r'><link name='b'><inertial><mass value='1'/><inertia ixx='1' "
                      "iyy='1' izz='1' "
                      "ixy='0' ixz='0' iyz='0'/></inertial><visual><origin xyz='1 0 0'/><geometry>"
                      "<box size='1 2 3'/></geometry></visual></link></robot>");
    const auto scene = load_sdf(file).scene;
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(std::get<Box>(scene->objects[0].shape).size_m, glm::dvec3(1, 2, 3));
    expect_near(in_world(*scene, 0, {0, 0, 0}), {1, 0, 0});
}

TEST_F(Sdf, materialsAreNamesOnceEach) {
    const std::string script =
        "<material><script><uri>x</uri><name>Gazebo/Grey</name></script></material>";
    const std::string ours = "<scipd:material>oak</scipd:material>";
    folder_.write("a.obj", triangle_obj);
    const auto scene = load(world(model_of(
        visual("a", unit_box) + visual("b", unit_box, ours) + visual("c", unit_box, script) +
        visual("d", unit_box, ours + script) + visual("e", mesh_of("a.obj")) +
        visual("f", mesh_of("a.obj"), "<scipd:material>default</scipd:material>"))));
    EXPECT_EQ(scene->materials[0].name, "default");
    EXPECT_EQ(material_of(*scene, 0), "default");
    EXPECT_EQ(material_of(*scene, 1), "oak");
    EXPECT_EQ(material_of(*scene, 2), "Gazebo/Grey");
    EXPECT_EQ(material_of(*scene, 3), "oak");
    EXPECT_EQ(material_of(*scene, 4), "oak");
    EXPECT_EQ(scene->objects[5].material, 0U);
    EXPECT_EQ(scene->materials.size(), 3U);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(Sdf, aMeshOfTwoMaterialsIsTwoObjects) {
    folder_.write(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl oak\nf 1 2 3\nusemtl steel\nf 3 2 1\nf 2 1 3\n");
    const auto scene = load(world(model_of(visual("v", mesh_of("a.obj")))));
    ASSERT_EQ(scene->objects.size(), 2U);
    EXPECT_EQ(scene->objects[0].name, scene->objects[1].name);
    EXPECT_EQ(material_of(*scene, 0), "oak");
    EXPECT_EQ(material_of(*scene, 1), "steel");
}

TEST_F(Sdf, oneMeshFileIsSharedAtEachScale) {
    folder_.write("meshes/a.obj", triangle_obj);
    const auto scene = load(world(model_of(
        visual("a", mesh_of("meshes/a.obj")) + visual("b", mesh_of("file://meshes/a.obj")) +
        visual("c", "<mesh><uri>meshes/a.obj</uri><scale>2 2 2</scale></mesh>"))));
    ASSERT_EQ(scene->objects.size(), 3U);
    const auto mesh = [&](std::size_t i) { return std::get<SharedMesh>(scene->objects[i].shape); };
    EXPECT_EQ(mesh(0), mesh(1));
    EXPECT_NE(mesh(0), mesh(2));
    EXPECT_EQ(mesh(2)->vertices_m[1] - mesh(2)->vertices_m[0],
              2.F * (mesh(0)->vertices_m[1] - mesh(0)->vertices_m[0]));
}

TEST_F(Sdf, meshesAreFoundByEveryKindOfUri) {
    folder_.write("m/meshes/a.obj", triangle_obj);
    folder_.write("m/package.xml", "<package><name>other</name></package>");
    const auto absolute = (folder_.path() / "m/meshes/a.obj").string();
    for (const auto& uri :
         {std::string{"meshes/a.obj"}, "file://" + absolute, absolute,
          std::string{"model://m/meshes/a.obj"}, std::string{"package://m/meshes/a.obj"},
          std::string{"package://other/meshes/a.obj"}}) {
        const auto file = folder_.write("m/a.sdf", world(model_of(visual("v", mesh_of(uri)))));
        EXPECT_EQ(load_sdf(file).scene->objects.size(), 1U) << uri;
    }
}

TEST_F(Sdf, meshesOfOtherModelsAreNotTakenFromThisOne) {
    folder_.write("m/meshes/a.obj", triangle_obj);
    folder_.write("m/model.config", "<model><name>m</name></model>");
    for (const std::string uri : {"model://gone/meshes/a.obj", "package://gone/meshes/a.obj"}) {
        const auto file = folder_.write(
            "m/a.sdf", world(model_of(visual("b", unit_box) + visual("v", mesh_of(uri)))));
        const auto loaded = load_sdf(file);
        EXPECT_EQ(loaded.scene->objects.size(), 1U);
        EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("there is no '" + uri + "'")));
    }
}

TEST_F(Sdf, anchorIsAWholePointNearTheMiddle) {
    const auto scene =
        load(world("<model name='m'><pose>10000 -20000 0 0 0 0</pose><link name='l'>" +
                   visual("a", unit_box, "<pose>0.2 0 0 0 0 0</pose>") +
                   visual("b", unit_box, "<pose>10 0 0 0 0 0</pose>") + "</link></model>"));
    expect_near(scene->anchor_m, {10005, -20000, 0});
}

TEST_F(Sdf, whatIsNotSupportedIsWarnedOfOnce) {
    const std::string relief = "<image><uri>a.png</uri></image>";
    const auto scene =
        load(world(model_of(visual("a", unit_box) + visual("b", relief) + visual("c", relief))));
    EXPECT_EQ(scene->objects.size(), 1U);
    const auto place = (folder_.path() / "a.sdf").string();
    EXPECT_THAT(warnings_,
                ElementsAre(place + ":6: m::l::b: <image> is not supported and left out, here "
                                    "and elsewhere"));
}

TEST_F(Sdf, whatSdfDoesNotKnowIsNotLookedAt) {
    load(world(model_of(visual("a", unit_box, "<colour>red</colour>"))));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(Sdf, collisionsAloneAreNotSeen) {
    load(world(model_of(visual("v", unit_box)) +
               "<model name='n'><link name='l'><collision name='c'><geometry>" + unit_box +
               "</geometry></collision></link></model>"));
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_THAT(warnings_[0], HasSubstr("n::l has collisions but no visual; scanners see visuals "
                                        "only; with geometry: collision"));
}

TEST_F(Sdf, ofSeveralWorldsTheFirstIsUsed) {
    const auto scene =
        load(sdf("<world name='one'>" + model_of(visual("v", unit_box)) +
                 "</world><world name='two'>" + model_of(visual("v", unit_box)) + "</world>"));
    EXPECT_EQ(scene->name, "one");
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_THAT(warnings_[0], HasSubstr("holds several worlds; only the first, 'one', is used"));
}

TEST_F(Sdf, threadsMayLoadAtTheSameTime) {
    const auto good = folder_.write("good.sdf", world(model_of(visual("v", unit_box))));
    const auto odd = folder_.write(
        "odd.sdf",
        world(model_of(visual("v", "<box><size>x</size></box>") + visual("w", unit_box))));
    std::size_t warnings_of_good = 0;
    std::size_t warnings_of_odd = 0;
    std::thread other{[&] {
        for (int i = 0; i < 5; ++i)
            warnings_of_odd += load_sdf(odd).warnings.size();
    }};
    for (int i = 0; i < 5; ++i)
        warnings_of_good += load_sdf(good).warnings.size();
    other.join();
    EXPECT_EQ(warnings_of_good, 0U);
    EXPECT_EQ(warnings_of_odd, 5U);
}

}  // namespace
}  // namespace scipd::sim
