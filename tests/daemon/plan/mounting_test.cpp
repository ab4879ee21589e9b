// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Mounts by name in worlds that are there already, and the literal words for those that are not.
#include "daemon/plan/mounting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Figures of a UST-10LX.
const sim::Lidar lidar{1081, 1, -2.35619, 2.35619, 0.02, 30.0, 40.0};

sim::Pose at(double x_m, double yaw_rad = 0.0) {
    return sim::pose_from_rpy({x_m, 0.0, 0.0}, {0.0, 0.0, yaw_rad});
}

/// Two carts that move and a house that does not, each with a lidar.
sim::Scene scene() {
    sim::Scene scene;
    scene.models = {{"cart", true, at(1)}, {"truck", true, at(2)}, {"house", false, at(3)}};
    scene.frames = {{"cart::base", 0, at(0.1), {}, {}},
                    {"cart::base::lds", 0, at(0.2), "ray", lidar},
                    {"cart::base::eye", 0, at(0.25), "camera", {}},
                    {"truck::base", 1, at(0.3), {}, {}},
                    {"truck::base::lds", 1, at(0.4), "ray", lidar},
                    {"house::roof", 2, at(0.5), {}, {}},
                    {"house::roof::top", 2, at(0.6), "gpu_lidar", lidar}};
    return scene;
}

class Mounting : public testing::Test {
  protected:
    Mounting() {
        config_.scene = "w.sdf";
        config_.robots = {robot("r")};
    }

    static RobotConfig robot(const std::string& name) {
        SensorConfig sensor;
        sensor.name = "s";
        sensor.model = find_model("UST-10LX");
        RobotConfig robot;
        robot.name = name;
        robot.sensors = {sensor};
        return robot;
    }

    std::vector<std::string> mount(const std::string& name, MountKind kind = MountKind::any,
                                   bool chooses_model = false) {
        sensor().mount = {.kind = kind, .name = name, .chooses_model = chooses_model};
        return mount_by_name(config_, scene());
    }

    std::vector<std::string> faults() {
        try {
            mount_by_name(config_, scene());
        } catch (const sim::LoadError& error) {
            return error.faults();
        }
        return {};
    }
    std::vector<std::string> faults(const std::string& name, MountKind kind = MountKind::any) {
        sensor().mount = {.kind = kind, .name = name};
        return faults();
    }

    RobotConfig& rider() { return config_.robots.at(0); }
    SensorConfig& sensor() { return rider().sensors.at(0); }

    Config config_;
};

TEST_F(Mounting, AMovableModelIsTheBodyAndTheStart) {
    EXPECT_THAT(mount("cart::base"), IsEmpty());
    EXPECT_EQ(sensor().robot_from_sensor, at(0.1));
    EXPECT_EQ(rider().body, "cart");
    EXPECT_EQ(rider().world_from_robot, at(1));
}

TEST_F(Mounting, AModelThatDoesNotMoveIsWhereTheRobotStarts) {
    mount("roof");
    EXPECT_EQ(sensor().robot_from_sensor, at(0.5));
    EXPECT_EQ(rider().body, "");
    EXPECT_EQ(rider().world_from_robot, at(3));
}

TEST_F(Mounting, WhatIsSaidOfTheRobotStays) {
    rider().pose_given = true;
    rider().world_from_robot = at(7);
    rider().body = "truck";
    mount("base");  // one there, two in the world
    EXPECT_EQ(sensor().robot_from_sensor, at(0.3));
    EXPECT_EQ(rider().body, "truck");
    EXPECT_EQ(rider().world_from_robot, at(7));
}

TEST_F(Mounting, AnOffsetCountsFromTheFrame) {
    sensor().mount = {.name = "cart::base", .frame_from_sensor = at(0.01)};
    mount_by_name(config_, scene());
    EXPECT_NEAR(sensor().robot_from_sensor.translation_m.x, 0.11, 1e-12);
}

TEST_F(Mounting, TheBestProductTakesThePlaceOfTheDefault) {
    sensor().model = find_model("URG-04LX");
    EXPECT_THAT(mount("cart::base::lds", MountKind::lidar, true),
                ElementsAre("r/s: of all models UST-10LX fits cart::base::lds best"));
    EXPECT_EQ(sensor().model, find_model("UST-10LX"));
}

TEST_F(Mounting, AProductThatTheUserChoseStays) {
    sensor().model = find_model("UHG-08LX");
    EXPECT_THAT(mount("top", MountKind::sensor),
                ElementsAre("r/s: UST-10LX would fit house::roof::top better than UHG-08LX; "
                            "UHG-08LX has 0.03 to 11 m instead of 0.02 to 30 m, 769 steps instead "
                            "of 1081, 15 Hz instead of 40 Hz"));
    EXPECT_EQ(sensor().model, find_model("UHG-08LX"));
}

TEST_F(Mounting, TheProductThatIsChosenMustPowerUpAsAsked) {
    sensor().power_up = PowerUp::scip1;
    sensor().mount = {.kind = MountKind::lidar, .name = "top", .chooses_model = true};
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("UST-10LX never spoke SCIP 1.1")));
}

TEST_F(Mounting, ANameMustBeOfOnePlace) {
    EXPECT_THAT(faults("lds"),
                ElementsAre("\"lds\" may be one of several in w.sdf: "
                            "cart::base::lds, truck::base::lds; write one of these"));
    EXPECT_THAT(faults("nothing", MountKind::lidar),
                ElementsAre("w.sdf has no lidar \"nothing\"; there are: cart::base::lds, "
                            "truck::base::lds, house::roof::top"));
    EXPECT_THAT(faults("eye", MountKind::lidar), ElementsAre(HasSubstr("no lidar \"eye\"")));
    EXPECT_THAT(faults("oof"), ElementsAre(HasSubstr("has no link, frame or sensor \"oof\"")));
    EXPECT_THAT(faults("cart::base", MountKind::sensor), ElementsAre(HasSubstr("no sensor")));
    EXPECT_THAT(faults("cart::base::lds", MountKind::link),
                ElementsAre("w.sdf has no link or frame \"cart::base::lds\"; there are: "
                            "cart::base, truck::base, house::roof"));
    rider().body = "truck";
    EXPECT_THAT(faults("cart::base"),
                ElementsAre("model \"truck\" of w.sdf has no link, frame or sensor "
                            "\"cart::base\"; there are: truck::base, truck::base::lds"));
}

TEST_F(Mounting, FaultsHaveTheirPlace) {
    config_.places["robots.r.sensors.s.mount"] = "rig.yaml:7: robots.r.sensors.s.mount: ";
    EXPECT_THAT(
        faults("x"),
        ElementsAre(testing::StartsWith("rig.yaml:7: robots.r.sensors.s.mount: w.sdf has no ")));
}

TEST_F(Mounting, ARobotIsOfOneModel) {
    SensorConfig other = sensor();
    other.name = "t";
    other.mount = {.name = "house::roof"};
    rider().sensors.push_back(other);
    rider().pose_given = true;
    EXPECT_THAT(faults("cart::base"), ElementsAre(HasSubstr("model \"cart\" of w.sdf has no")));
    config_.robots = {robot("r"), robot("q")};
    config_.robots[1].sensors[0].mount = {.name = "cart::base"};
    EXPECT_THAT(faults("cart::base::lds"),
                ElementsAre("lies in model \"cart\", which is the body of robot \"r\"; make it a "
                            "sensor of that one"));
}

TEST_F(Mounting, IsFoundAgainInAnotherWorldWithinItsModel) {
    mount("cart::base::lds");
    sim::Scene other = scene();
    other.frames[1].model_from_frame = at(0.9);
    EXPECT_EQ(mounted_again(*sensor().mount, other), at(0.9));
    other.frames.erase(other.frames.begin() + 1);
    EXPECT_EQ(mounted_again(*sensor().mount, other), std::nullopt);
    // An end of a name goes by the model in which it was found.
    config_.robots = {robot("r")};
    mount("roof");
    other = scene();
    other.models[2].name = "shed";
    EXPECT_EQ(mounted_again(*sensor().mount, other), std::nullopt);
}

}  // namespace
}  // namespace scipd::daemon
