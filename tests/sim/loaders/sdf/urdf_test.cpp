// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Robots in URDF, as people have them: without inertia, with fixed joints, meshes in packages, and
// materials by name.

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/backends/registry.h"
#include "sim/loaders/sdf/sdf.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string robot(const std::string& inside) {
    return "<?xml version='1.0'?>\n<robot name='r'>\n" + inside + "\n</robot>\n";
}

std::string box_visual(const std::string& size, const std::string& more = {}) {
    return "<visual>" + more + "<geometry><box size='" + size + "'/></geometry></visual>";
}

/// A chassis, a mast fixed on it 1 m ahead and 1 m up that is turned to the left, and an arm that
/// turns on the mast, 2 m further along the mast's x.
const std::string three_links = robot(
    "<material name='red'><color rgba='1 0 0 1'/></material>\n"
    "<link name='chassis'>" +
    box_visual("1 1 0.2", "<material name='red'/>") +
    box_visual("0.2 0.2 0.4", "<origin xyz='-1 0 0'/><material name='rubber'/>") +
    "<collision><geometry><box size='3 3 0.2'/></geometry></collision></link>\n"
    "<link name='mast'>" +
    box_visual("0.2 0.4 0.2", "<material name='unknown'><color rgba='0 0 0 1'/></material>") +
    "</link>\n<link name='arm'>" + box_visual("0.5 0.5 0.5") +
    "</link>\n"
    "<joint name='weld' type='fixed'><parent link='chassis'/><child link='mast'/>"
    "<origin xyz='1 0 1' rpy='0 0 1.5707963267948966'/></joint>\n"
    "<joint name='hinge' type='revolute'><parent link='mast'/><child link='arm'/>"
    "<origin xyz='2 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' "
    "velocity='1'/></joint>\n"
    "<transmission name='t'/><gazebo><plugin name='p' filename='libp.so'/></gazebo>");

class Urdf : public ::testing::Test {
  protected:
    LoadedScene load(const std::string& text, const SdfOptions& options = {}) {
        return load_sdf(folder_.write("a.urdf", text), options);
    }
    std::vector<std::string> faults(const std::string& text, const SdfOptions& options = {}) {
        const auto file = folder_.write("a.urdf", text);
        return faults_of([&] { load_sdf(file, options); }, folder_);
    }
    static glm::dvec3 origin_of(const Scene& scene, std::size_t object) {
        const auto& that = scene.objects.at(object);
        return (scene.models.at(that.model).world_from_model * that.model_from_object)
            .translation_m;
    }
    TempDir folder_;
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
    EXPECT_NEAR(a.z, b.z, 1e-9);
}

TEST_F(Urdf, IsOneBodyWithAllJointsAtZero) {
    ::testing::internal::CaptureStderr();
    const auto [scene, warnings] = load(three_links);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_THAT(warnings, IsEmpty());
    ASSERT_EQ(scene->models.size(), 1U);
    EXPECT_EQ(scene->models[0].name, "r");
    EXPECT_TRUE(scene->models[0].movable);
    ASSERT_EQ(scene->objects.size(), 4U);
    expect_near(origin_of(*scene, 0), {0, 0, 0});
    expect_near(origin_of(*scene, 1), {-1, 0, 0});
    EXPECT_THAT(scene->objects[2].name, HasSubstr("r::mast::"));
    expect_near(origin_of(*scene, 2), {1, 0, 1});
    EXPECT_THAT(scene->objects[3].name, HasSubstr("r::arm::"));
    expect_near(origin_of(*scene, 3), {1, 2, 1});
}

TEST_F(Urdf, KeepsTheNamesOfMaterials) {
    const auto scene = load(three_links).scene;
    const auto material = [&](std::size_t object) {
        return scene->materials.at(scene->objects.at(object).material).name;
    };
    EXPECT_EQ(material(0), "red");
    EXPECT_EQ(material(1), "rubber");
    EXPECT_EQ(material(2), "unknown");
    EXPECT_EQ(material(3), "default");
}

TEST_F(Urdf, ShowsCollisionsIfThatIsWanted) {
    const auto scene = load(three_links, {.geometry = SdfGeometry::collision}).scene;
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(std::get<Box>(scene->objects[0].shape).size_m, (glm::dvec3{3, 3, 0.2}));
}

TEST_F(Urdf, IsSeenWhereItStands) {
    auto backend = make_backend("reference", load(three_links).scene);
    const glm::vec3 ahead{1.F, 0.F, 0.F};
    const Pose low{{-5, 0, 0}, {1, 0, 0, 0}};
    const Pose high{{-5, 2, 1}, {1, 0, 0, 0}};
    Hit hit;
    backend->cast({.directions = {&ahead, 1}, .world_from_sensor = {&low, 1}}, {&hit, 1});
    EXPECT_NEAR(hit.range_m, 3.9, 1e-6);
    backend->cast({.directions = {&ahead, 1}, .world_from_sensor = {&high, 1}}, {&hit, 1});
    EXPECT_NEAR(hit.range_m, 5.75, 1e-6);
}

TEST_F(Urdf, MayStandInAWorld) {
    folder_.write("robots/three.urdf", three_links);
    const auto file = folder_.write(
        "w.sdf",
        world("<include><uri>robots/three.urdf</uri><name>one</name><pose>0 0 5 0 0 0</pose>"
              "</include><include><uri>robots/three.urdf</uri><name>two</name></include>"));
    const auto scene = load_sdf(file).scene;
    ASSERT_EQ(scene->models.size(), 2U);
    EXPECT_EQ(scene->models[1].name, "two");
    ASSERT_EQ(scene->objects.size(), 8U);
    expect_near(origin_of(*scene, 3), {1, 2, 6});
    EXPECT_EQ(scene->materials.at(scene->objects[5].material).name, "rubber");
}

TEST_F(Urdf, FindsPackagesAbroadAndAround) {
    const auto mesh = [](const std::string& uri) {
        return robot("<link name='l'><visual><geometry><mesh filename='" + uri +
                     "' scale='2 2 2'/></geometry></visual></link>");
    };
    folder_.write("home/pkg/meshes/a.obj", triangle_obj);
    folder_.write("ws/src/stack/other/b.obj", triangle_obj);
    folder_.write("install/share/third/c.obj", triangle_obj);
    const auto here =
        folder_.write("home/pkg/urdf/deep/a.urdf", mesh("package://pkg/meshes/a.obj"));
    EXPECT_EQ(load_sdf(here).scene->objects.size(), 1U);
    setenv("ROS_PACKAGE_PATH", (folder_.path() / "ws/src").c_str(), 1);
    setenv("AMENT_PREFIX_PATH", (folder_.path() / "install").c_str(), 1);
    EXPECT_EQ(load(mesh("package://other/b.obj")).scene->objects.size(), 1U);
    EXPECT_EQ(load(mesh("package://third/c.obj")).scene->objects.size(), 1U);
    EXPECT_EQ(load(mesh("home/pkg/meshes/a.obj")).scene->objects.size(), 1U);
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
    EXPECT_THAT(faults(mesh("package://other/b.obj")),
                Contains("a.urdf:3: r::l::l_visual: there is no 'package://other/b.obj' near " +
                         folder_.path().string() +
                         ", nor in GZ_SIM_RESOURCE_PATH, GAZEBO_MODEL_PATH, SDF_PATH, "
                         "ROS_PACKAGE_PATH or AMENT_PREFIX_PATH; left out"));
}

TEST_F(Urdf, TellsEveryFaultAndItsLine) {
    EXPECT_THAT(faults(robot("<link name='a'>" + box_visual("1 x 1") + "</link>\n<link name='b'>" +
                             "<visual><geometry><torus/></geometry></visual></link>\n"
                             "<joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
                             "</joint>"),
                       {.strict = true}),
                ElementsAre("a.urdf:3: r::a::a_visual: its <box size='1 x 1'> cannot be read",
                            "a.urdf:4: r::b::b_visual: URDF has no <torus>"));
    const std::string seen = "<link name='s'>" + box_visual("1 1 1") + "</link>";
    EXPECT_THAT(
        faults(robot(seen + "\n<link name='b'/>"), {.strict = true}),
        ElementsAre("a.urdf:4: link b: hangs on no joint; it stands at the origin of the robot"));
    EXPECT_THAT(faults(robot(seen + "\n<joint name='j' type='fixed'><parent link='s'/>"
                                    "<child link='c'/></joint>"),
                       {.strict = true}),
                ElementsAre("a.urdf:4: joint j: its <child> c is no link; left out"));
    EXPECT_THAT(faults("<robot>" + seen + "</robot>", {.strict = true}),
                ElementsAre("a.urdf:1: a model has no name; this one is called model_0"));
}

TEST_F(Urdf, TellsFaultsOfARobotInAWorldUnderItsOwnName) {
    folder_.write("bad.urdf", "<robot name='r'><link><visual/></link></robot>");
    const auto file = folder_.write("w.sdf", world("<include><uri>bad.urdf</uri></include>"));
    EXPECT_THAT(faults_of([&] { load_sdf(file); }, folder_),
                ElementsAre("bad.urdf:1: link: has no name; left out",
                            HasSubstr("w.sdf: holds nothing that a scanner could see")));
}

// Whatever is wrong with a joint, every link with a name is seen whose place is known.
TEST_F(Urdf, LosesOnlyTheJointsThatHangOnNothing) {
    const std::string links = "<link name='a'>" + box_visual("1 1 1") + "</link><link name='b'>" +
                              box_visual("2 2 2") + "</link>\n";
    const auto joint = [](const std::string& inside, const std::string& name = "name='j'") {
        return "<joint " + name + " type='fixed'>" + inside + "</joint>\n";
    };
    const std::string ends = "<parent link='a'/><child link='b'/>";
    const std::string up = "<origin xyz='0 0 3'/>";
    const std::string alone = "link b: hangs on no joint; it stands at the origin of the robot";
    const auto expect = [&](const std::string& joints, double z_m,
                            const std::vector<std::string>& told) {
        SCOPED_TRACE(joints);
        const auto loaded = load(robot(links + joints));
        ASSERT_EQ(loaded.scene->objects.size(), 2U);
        EXPECT_EQ(loaded.scene->objects[0].name.substr(0, 4), "r::a");
        EXPECT_EQ(loaded.scene->objects[1].name.substr(0, 4), "r::b");
        expect_near(origin_of(*loaded.scene, 0), {0, 0, 0});
        expect_near(origin_of(*loaded.scene, 1), {0, 0, z_m});
        std::vector<std::string> warnings = without_folder(loaded.warnings, folder_);
        for (std::string& warning : warnings)
            warning = warning.substr(warning.find(": ") + 2);
        EXPECT_EQ(warnings, told);
    };
    expect(joint(ends + up), 3, {});
    expect(joint(ends + up, ""), 3, {});
    expect("", 0, {alone});
    expect(joint("<child link='b'/>" + up), 0,
           {"joint j: has no <parent link='..'>; left out", alone});
    expect(joint("<parent link='a'/>" + up), 0,
           {"joint j: has no <child link='..'>; left out", alone});
    expect(joint("<parent link='a'/><child link='c'/>"), 0,
           {"joint j: its <child> c is no link; left out", alone});
    expect(joint(ends + up) + joint(ends), 3, {"joint j: link b hangs on another joint; left out"});
    expect(joint(ends + up) + joint("<parent link='b'/><child link='a'/>", "name='k'"), 3,
           {"joint k: its parent hangs on its child; left out"});
    expect(joint(ends + up) + "<link/><link name='a'/>", 3,
           {"link: has no name; left out", "link a: there is another of this name; left out"});
}

// A scanner would see it elsewhere.
TEST_F(Urdf, LosesWhatHangsWhereNobodyKnows) {
    const std::string seen = box_visual("1 1 1") + "</link>";
    const auto loaded =
        load(robot("<link name='a'>" + seen + "<link name='b'>" + seen + "<link name='c'>" + seen +
                   "\n<joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
                   "<origin xyz='0 up 3' rpy='0'/></joint>"
                   "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>"));
    ASSERT_EQ(loaded.scene->objects.size(), 1U);
    EXPECT_EQ(loaded.scene->objects[0].name.substr(0, 4), "r::a");
    EXPECT_THAT(loaded.warnings,
                ElementsAre(HasSubstr("joint j: its <origin xyz='0 up 3'> cannot be read; what "
                                      "hangs on it is left out")));
}

TEST_F(Urdf, StandsOnTheWorldIfItSaysSo) {
    const auto scene =
        load(robot("<link name='world'/><link name='a'>" + box_visual("1 1 1") +
                   "</link><joint name='j' type='fixed'><parent link='world'/><child link='a'/>"
                   "<origin xyz='0 0 3'/></joint>"))
            .scene;
    ASSERT_EQ(scene->objects.size(), 1U);
    expect_near(origin_of(*scene, 0), {0, 0, 3});
}

}  // namespace
}  // namespace scipd::sim
