// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Places in a room of 6 m by 4 m that nobody meant, and odd ones that somebody did.
#include "daemon/plan/unlikely_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

sim::Scene room(double size_m = 6.0) {
    sim::Scene scene;
    scene.models = {{"room", false, sim::Pose{}}};
    scene.objects = {{"room::link::floor", 0, sim::Pose{}, sim::Box{{size_m, 4.0, 2.5}}}};
    return scene;
}

sim::Pose at(double x_m, double y_m, double z_m) {
    return {{x_m, y_m, z_m}, {1.0, 0.0, 0.0, 0.0}};
}

Config with(const sim::Pose& robot, const sim::Pose& mount) {
    Config config;
    SensorConfig sensor;
    sensor.name = "s";
    sensor.robot_from_sensor = mount;
    RobotConfig one;
    one.name = "r";
    one.world_from_robot = robot;
    one.sensors = {sensor};
    config.robots = {one};
    return config;
}

TEST(UnlikelyPlaces, AreToldWithWhatWasMeant) {
    EXPECT_THAT(warnings_of(with(at(1, 1, 0), at(200, 0, 250)), room()),
                ElementsAre("--mount: 200, 0, 250 looks like millimetres, but lengths are metres; "
                            "did you mean 0.2, 0, 0.25?"));
    Config config = with(at(1500, 2000, 0), at(0.2, 0, 0.25));
    config.places["robots.r.pose"] = "rig.yaml:3: robots.r.pose: ";
    EXPECT_THAT(warnings_of(config, room()),
                ElementsAre("rig.yaml:3: robots.r.pose.xyz: 1500, 2000, 0 looks like millimetres, "
                            "but lengths are metres; did you mean 1.5, 2, 0?"));
    // Where the mount is nothing to wonder at once the robot's place is right.
    EXPECT_EQ(warnings_of(with(at(1500, 2000, 0), at(0, 0, 0.25)), room()).size(), 1U);
}

TEST(UnlikelyPlaces, AreThoseOfNamedMountsToo) {
    Config config = with(at(1, 1, 0), at(101, 0, 1));
    config.robots[0].sensors[0].mount = NamedMount{.frame_from_sensor = at(100, 0, 0)};
    EXPECT_THAT(
        warnings_of(config, room()),
        ElementsAre("--mount: 100, 0, 0 looks like millimetres, but lengths are metres; did "
                    "you mean 0.1, 0, 0?"));
}

TEST(UnlikelyPlaces, AreNotThoseThatPeopleMean) {
    const sim::Pose deck = at(0.2, 0, 0.25);
    EXPECT_THAT(warnings_of(with(at(1, 1, 0), deck), room()), IsEmpty());
    // A robot that waits outside, one that flies, and a site of 300 m whose masts are mounts.
    EXPECT_THAT(warnings_of(with(at(12, 0, 0), deck), room()), IsEmpty());
    EXPECT_THAT(warnings_of(with(at(1, 1, 120), deck), room()), IsEmpty());
    EXPECT_THAT(warnings_of(with(at(0, 0, 0), at(140, 1, 5)), room(300.0)), IsEmpty());
    EXPECT_THAT(warnings_of(with(at(150, 1, 0), deck), room(300.0)), IsEmpty());
    // In an empty world nobody knows.
    EXPECT_THAT(warnings_of(with(at(0, 0, 0), at(200, 0, 250)), sim::Scene{}), IsEmpty());
}

TEST(UnlikelyPlaces, AreFaultsWhereTheConfigurationIsStrict) {
    Config config = with(at(1, 1, 0), at(0, 0, 0.2));
    config.warnings = {"--pose: 90 looks like degrees"};
    EXPECT_THAT(warnings_of(config, room()), ElementsAre("--pose: 90 looks like degrees"));
    config.strict = true;
    EXPECT_THROW((void)warnings_of(config, room()), sim::LoadError);
}

}  // namespace
}  // namespace scipd::daemon
