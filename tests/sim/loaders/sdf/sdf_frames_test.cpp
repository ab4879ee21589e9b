// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What worlds and robots offer as places for scanners: links, frames and sensors.
#include <algorithm>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/scene_file.h"
#include "tests/sim/loaders/faults_of.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// As turtlebot3_burger of turtlebot3_gazebo has its LDS-01.
constexpr const char* burgers_ray =
    "<ray><scan><horizontal><samples>360</samples><resolution>1.000000</resolution>"
    "<min_angle>0.000000</min_angle><max_angle>6.280000</max_angle></horizontal></scan>"
    "<range><min>0.120000</min><max>3.5</max><resolution>0.015000</resolution></range>"
    "<noise><type>gaussian</type><mean>0.0</mean><stddev>0.01</stddev></noise></ray>";

std::string sensor(const std::string& name, const std::string& inside,
                   const std::string& type = "ray") {
    return "<sensor name='" + name + "' type='" + type + "'>" + inside + "</sensor>\n";
}

class SdfFrames : public ::testing::Test {
  protected:
    const Scene& load(const std::string& text, const std::string& name = "a.sdf") {
        auto loaded = load_scene(folder_.write(name, text));
        warnings_ = std::move(loaded.warnings);
        scene_ = loaded.scene;
        return *scene_;
    }
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const Frame& frame : scene_->frames)
            names.push_back(frame.name);
        return names;
    }
    const Frame& frame(const std::string& name) const {
        const auto found = std::ranges::find(scene_->frames, name, &Frame::name);
        if (found == scene_->frames.end()) throw std::runtime_error("no frame " + name);
        return *found;
    }
    void expect_at(const std::string& name, const Pose& model_from_frame) const {
        SCOPED_TRACE(name);
        const Pose is = frame(name).model_from_frame;
        EXPECT_NEAR(glm::length(is.translation_m - model_from_frame.translation_m), 0.0, 1e-9);
        EXPECT_NEAR(angle_between_rad(is.rotation, model_from_frame.rotation), 0.0, 1e-7);
    }
    std::vector<std::string> faults(const std::string& text) {
        const auto file = folder_.write("a.sdf", text);
        return faults_of([&] { load_scene(file, {.sdf = {.strict = true}}); }, folder_);
    }

    TempDir folder_;
    SharedScene scene_;
    std::vector<std::string> warnings_;
};

/// A mast 0.5 m ahead and 0.2 m up that is turned to the left.
constexpr const char* mast_frame =
    "<frame name='mast' attached_to='base'><pose>0.5 0 0.2 0 0 1.5707963267948966</pose></frame>";

TEST_F(SdfFrames, linksFramesAndSensorsAreNamed) {
    load(world("<model name='bot'><pose>7 8 9 0 0 1</pose>" + std::string{mast_frame} +
               "<link name='base'><pose>1 0 0 0 0 0</pose>" + visual("v", unit_box) +
               sensor("lds", "<pose>0.1 0 0 0 0 0</pose><update_rate>5</update_rate>" +
                                 std::string{burgers_ray}) +
               sensor("top",
                      "<pose relative_to='mast'>0.1 0 0 0 0 0</pose><update_rate>5"
                      "</update_rate>" +
                          std::string{burgers_ray},
                      "gpu_lidar") +
               sensor("eye", "<pose>0 0 1 0 0 0</pose><camera/>", "camera") + "</link></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_THAT(names(), UnorderedElementsAre("bot::base", "bot::mast", "bot::base::lds",
                                              "bot::base::top", "bot::base::eye"));
    constexpr double left = std::numbers::pi / 2;
    expect_at("bot::base", pose_from_rpy({1, 0, 0}, {0, 0, 0}));
    expect_at("bot::mast", pose_from_rpy({1.5, 0, 0.2}, {0, 0, left}));
    expect_at("bot::base::lds", pose_from_rpy({1.1, 0, 0}, {0, 0, 0}));
    expect_at("bot::base::top", pose_from_rpy({1.5, 0.1, 0.2}, {0, 0, left}));
    expect_at("bot::base::eye", pose_from_rpy({1, 0, 1}, {0, 0, 0}));
    const Lidar lds{.samples = 360,
                    .rows = 1,
                    .min_angle_rad = 0.0,
                    .max_angle_rad = 6.28,
                    .min_range_m = 0.12,
                    .max_range_m = 3.5,
                    .rate_hz = 5.0};
    EXPECT_EQ(frame("bot::base::lds").lidar, lds);
    EXPECT_EQ(frame("bot::base::lds").sensor, "ray");
    EXPECT_EQ(frame("bot::base::top").sensor, "gpu_lidar");
    EXPECT_EQ(frame("bot::base::eye").sensor, "camera");
    EXPECT_EQ(frame("bot::base::eye").lidar, std::nullopt);
    EXPECT_EQ(frame("bot::mast").sensor, "");
}

TEST_F(SdfFrames, asOlderWorldsWriteThem) {
    load("<sdf version='1.5'><world name='w'><model name='bot'><link name='base'>" +
         visual("v", unit_box) + "</link><link name='in::ner'><pose>0 0 1 0 0 0</pose>" +
         sensor("lds", "<pose frame=''>0 0 0.5 0 0 0</pose>" + std::string{burgers_ray}) +
         sensor("hokuyo", "<pose>0 0 0.6 0 0 0</pose>" + std::string{burgers_ray}) +
         "</link></model></world></sdf>");
    EXPECT_THAT(warnings_, IsEmpty());
    expect_at("bot::in::ner::lds", pose_from_rpy({0, 0, 1.5}, {0, 0, 0}));
    expect_at("bot::in::ner::hokuyo", pose_from_rpy({0, 0, 1.6}, {0, 0, 0}));
    EXPECT_EQ(frame("bot::in::ner::lds").lidar->rate_hz, 0.0);
}

TEST_F(SdfFrames, ofNestedAndIncludedModels) {
    folder_.write("laser/model.config", "<model><sdf version='1.9'>model.sdf</sdf></model>");
    folder_.write("laser/model.sdf",
                  sdf("<model name='laser'><link name='box'>" + visual("v", unit_box) +
                      sensor("s", burgers_ray) + "</link></model>"));
    load(world("<model name='house'><static>true</static><link name='l'>" + visual("v", unit_box) +
               "</link><model name='door'><static>false</static><pose>2 0 0 0 0 0</pose>"
               "<link name='leaf'><pose>0 1 0 0 0 0</pose>" +
               visual("v", unit_box) +
               "</link></model><include><uri>model://laser</uri><name>north</name>"
               "<pose>0 3 0 0 0 0</pose></include></model>"));
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_THAT(names(),
                UnorderedElementsAre("house::l", "house::door", "house::door::leaf", "house::north",
                                     "house::north::box", "house::north::box::s"));
    // The door moves by itself.
    EXPECT_EQ(scene_->models.at(frame("house::door::leaf").model).name, "house::door");
    expect_at("house::door::leaf", pose_from_rpy({0, 1, 0}, {0, 0, 0}));
    EXPECT_EQ(scene_->models.at(frame("house::north::box::s").model).name, "house");
    expect_at("house::north::box::s", pose_from_rpy({0, 3, 0}, {0, 0, 0}));
    EXPECT_TRUE(frame("house::north::box::s").lidar);
}

TEST_F(SdfFrames, ofARobotWithFixedJoints) {
    load(
        "<robot name='tb'>\n<link name='base'><visual><geometry><box size='1 1 1'/></geometry>"
        "</visual></link>\n<link name='scan'/>\n"
        "<joint name='weld' type='fixed'><parent link='base'/><child link='scan'/>"
        "<origin xyz='-0.064 0 0.122' rpy='0 0 1.5707963267948966'/></joint>\n"
        "<gazebo reference='scan'><material>Gazebo/Red</material>\n" +
            sensor("lds", "<pose>0.1 0 0 0 0 0</pose>" + std::string{burgers_ray} +
                              "<plugin name='p' filename='libp.so'/>") +
            sensor("broken", "<update_rate>5</update_rate>") +
            sensor("eye", "<camera><image><width>wide</width></image></camera>", "camera") +
            "</gazebo>\n</robot>\n",
        "tb.urdf");
    EXPECT_THAT(names(),
                UnorderedElementsAre("tb::base", "tb::scan", "tb::scan::lds", "tb::scan::eye"));
    constexpr double left = std::numbers::pi / 2;
    expect_at("tb::scan", pose_from_rpy({-0.064, 0, 0.122}, {0, 0, left}));
    expect_at("tb::scan::lds", pose_from_rpy({-0.064, 0.1, 0.122}, {0, 0, left}));
    EXPECT_EQ(frame("tb::scan::lds").lidar->samples, 360);
    EXPECT_THAT(
        warnings_,
        ElementsAre(AllOf(HasSubstr("tb.urdf:7: sensor 'broken' of link 'scan' of model 'tb': "
                                    "has neither <lidar> nor <ray>"))));
}

TEST_F(SdfFrames, aFaultyLidarIsLeftOutWithOneWarning) {
    const auto replaced = [](const std::string& from, const std::string& to) {
        std::string text = burgers_ray;
        return text.replace(text.find(from), from.size(), to);
    };
    const auto expect_warned = [&](const std::string& inside, const std::string& why) {
        SCOPED_TRACE(inside);
        const std::string text = world("<model name='m'><link name='l'>" + visual("v", unit_box) +
                                       sensor("s", inside) + "</link></model>");
        load(text);
        EXPECT_THAT(names(), ElementsAre("m::l"));
        EXPECT_EQ(scene_->objects.size(), 1U);
        EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("a.sdf:5: "), HasSubstr(why),
                                                 HasSubstr("no scanner"))));
        EXPECT_THAT(faults(text), Not(IsEmpty()));
    };
    expect_warned("", "sensor 's' of link 'l' of model 'm': has neither <lidar> nor <ray>");
    expect_warned("<ray/>", "has no <scan> in its <ray>");
    expect_warned(replaced("6.280000", "nan"), "<max_angle> must be one number");
    expect_warned(replaced("6.280000", "x"), "<max_angle> has 'x'");
    expect_warned(replaced("6.280000", "360"), "they are in radians");
    expect_warned(replaced("6.280000", "-1"), "<max_angle> must be <min_angle> or more");
    expect_warned(replaced("3.5", "0.1"), "<min> in its <range> must be 0 or more");
    expect_warned(replaced("360", "0"), "<samples>");
    expect_warned("<update_rate>-1</update_rate>" + std::string{burgers_ray}, "<update_rate>");
    expect_warned("<pose>1 2 3</pose>" + std::string{burgers_ray},
                  "its <pose> '1 2 3' cannot be read");
    expect_warned("<pose relative_to='gone'>0 0 0 0 0 0</pose>" + std::string{burgers_ray},
                  "relative to 'gone'");
}

TEST_F(SdfFrames, ofTwoSensorsOfOneNameTheFirstCounts) {
    load(world("<model name='m'><link name='l'>" + visual("v", unit_box) +
               sensor("s", "<pose>1 0 0 0 0 0</pose>" + std::string{burgers_ray}) +
               sensor("s", "<pose>2 0 0 0 0 0</pose>" + std::string{burgers_ray}) +
               "</link></model>"));
    expect_at("m::l::s", pose_from_rpy({1, 0, 0}, {0, 0, 0}));
    EXPECT_THAT(warnings_, ElementsAre(HasSubstr("not the first of this name")));
}

TEST_F(SdfFrames, ofTwoLinksOfOneNameTheFirstCounts) {
    const std::string moved = "<pose>5 0 0 0 0 0</pose>";
    load(world("<model name='m'><link name='l'>" + visual("v", unit_box) +
               "</link><link name='l'>" + moved + visual("v", unit_box) + sensor("s", burgers_ray) +
               "</link><model name='n'><link>" + moved + visual("v", unit_box) +
               sensor("s", burgers_ray) + "</link></model></model>"));
    EXPECT_TRUE(std::ranges::none_of(scene_->frames, [](const Frame& f) { return !!f.lidar; }));
    EXPECT_THAT(warnings_, testing::Contains(HasSubstr("its link is not the first of this name")));
    EXPECT_THAT(warnings_, testing::Contains(HasSubstr("its link has no name")));
}

// Where a saved world has moved its link.
TEST_F(SdfFrames, lieWhereTheStateHasThem) {
    load(
        world("<model name='m'><link name='l'>" + visual("v", unit_box) +
              "</link><link name='arm'>"
              "<pose>1 0 0 0 0 0</pose>" +
              visual("v", unit_box) +
              sensor("s", "<pose>0.5 0 0 0 0 0</pose>" + std::string{burgers_ray}) +
              "</link></model><state world_name='w'><model name='m'><pose>0 0 3 0 0 0</pose>"
              "<link name='arm'><pose>0 2 3 0 0 1.5707963267948966</pose></link></model></state>"));
    constexpr double left = std::numbers::pi / 2;
    expect_at("m::arm", pose_from_rpy({0, 2, 0}, {0, 0, left}));
    expect_at("m::arm::s", pose_from_rpy({0, 2.5, 0}, {0, 0, left}));
}

TEST_F(SdfFrames, aCrowdOfSensorsIsOffered) {
    std::string models;
    for (int model = 0; model < 41; ++model) {
        models +=
            "<model name='m" + std::to_string(model) + "'><link name='l'>" + visual("v", unit_box);
        for (int i = 0; i < 100; ++i)
            models += sensor(std::to_string(i), burgers_ray);
        models += "</link></model>\n";
    }
    load(world(models));
    EXPECT_EQ(std::ranges::count_if(scene_->frames, [](const Frame& f) { return !!f.lidar; }),
              4100);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(SdfFrames, aStrictWorldOffersTheSame) {
    const std::string text = world(
        "<model name='m'><link name='l'>" + visual("v", unit_box) +
        sensor("s", "<pose>1 0 0 0 0 0</pose>" + std::string{burgers_ray}) + "</link></model>");
    scene_ = load_scene(folder_.write("a.sdf", text), {.sdf = {.strict = true}}).scene;
    EXPECT_THAT(names(), UnorderedElementsAre("m::l", "m::l::s"));
    expect_at("m::l::s", pose_from_rpy({1, 0, 0}, {0, 0, 0}));
}

TEST_F(SdfFrames, rangesMayHaveNoEnd) {
    std::string ray = burgers_ray;
    ray.replace(ray.find("3.5"), 3, "inf");
    load(world("<model name='m'><link name='l'>" + visual("v", unit_box) + sensor("s", ray) +
               "</link></model>"));
    EXPECT_EQ(frame("m::l::s").lidar->max_range_m, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace scipd::sim
