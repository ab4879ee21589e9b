// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses that come by the bus of another program, as a configuration names them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/bridges/available.h"
#include "daemon/config/config_file.h"
#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using PoseSourceTest = ConfigFixture;

TEST_F(PoseSourceTest, ReadsWhichTopicAndFramesOfRos2MoveARobot) {
    if (!check_ros2_is_built()) GTEST_SKIP() << check_ros2_is_built().error().why;
    const auto source = [&](const std::string& poses) {
        return *parse("robots: {r: {poses: " + poses +
                      ", sensors: {s: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}")
                    .robots[0]
                    .poses;
    };
    EXPECT_EQ(source("'ros2:/odom'").topic, "/odom");
    const PoseSource tf = source("{ros2: {topic: /tf, parent: map, child: base}}");
    EXPECT_EQ(tf.kind, PoseSource::Kind::ros2);
    EXPECT_EQ(tf.topic, "/tf");
    EXPECT_EQ(tf.frames, (RosFrames{"map", "base"}));
    EXPECT_EQ(source("{from: 'ros2:/tf', ros2: {child: base}}").frames.child, "base");
}

TEST_F(PoseSourceTest, RefusesTopicsAndFramesOfNothing) {
    if (!check_ros2_is_built()) GTEST_SKIP() << check_ros2_is_built().error().why;
    const auto faults_of = [&](const std::string& poses) {
        return faults("robots: {r: {poses: " + poses +
                      ", sensors: {s: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}");
    };
    const std::string place = "rig.yaml:1: robots.r.poses";
    EXPECT_THAT(faults_of("'ros2:odom'"),
                ElementsAre(place + ": must be a topic of ROS such as /odom, not 'odom'"));
    EXPECT_THAT(faults_of("{ros2: {child: base}}"),
                ElementsAre(place + ".ros2: needs topic: /TOPIC"));
    EXPECT_THAT(faults_of("{from: 'udp:127.0.0.1:1', ros2: {child: base}}"),
                ElementsAre(place + ".ros2: goes with from: ros2:/TOPIC, or rosbridge:"));
}

TEST_F(PoseSourceTest, SaysWhichSourcesThereAreWhereOneIsMisspelt) {
    const auto faults_of = [&](const std::string& poses) {
        return faults("robots: {r: {poses: '" + poses +
                      "', sensors: {s: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}")
            .at(0);
    };
    EXPECT_THAT(faults_of("gazebo:/poses"),
                EndsWith("gazebo:/poses', and no source 'gazebo:'; there are udp:, gz:, ros2:, "
                         "rosbridge: and vda5050:"));
    EXPECT_THAT(faults_of("drive.tum"), EndsWith("drive.tum'"));
}

TEST_F(PoseSourceTest, ReadsWhichTopicAndNameOfGazeboMoveARobot) {
    if (!check_gz_is_built()) GTEST_SKIP() << check_gz_is_built().error().why;
    const std::string rest = ", sensors: {s: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}";
    const auto source = [&](const std::string& poses) {
        return *parse("robots: {r: {poses: " + poses + rest).robots[0].poses;
    };
    EXPECT_EQ(source("'gz:'").kind, PoseSource::Kind::gz);
    EXPECT_EQ(source("'gz:'").topic, "");
    EXPECT_EQ(source("{from: 'gz:/poses', gz: {robot: rescue::base_link}}").called,
              "rescue::base_link");
    EXPECT_THAT(faults("robots: {r: {poses: 'gz:poses'" + rest),
                ElementsAre("rig.yaml:1: robots.r.poses: must be gz:/TOPIC, or gz: for the poses "
                            "of the world that is loaded, not 'poses'"));
}

TEST_F(PoseSourceTest, ReadsWhereRosbridgeIs) {
    const std::string rest = ", sensors: {s: {model: UST-10LX, tcp: '127.0.0.1:0'}}}}";
    const auto config = parse(
        "robots: {r: {poses: {from: 'rosbridge:ws://robot.lan:9090/a/odom', "
        "ros2: {child: base}}" +
        rest);
    const PoseSource& source = *config.robots[0].poses;
    EXPECT_EQ(source.kind, PoseSource::Kind::rosbridge);
    EXPECT_EQ(source.address, (Address{"robot.lan", 9090}));
    EXPECT_EQ(source.topic, "/a/odom");
    EXPECT_EQ(source.frames.child, "base");
    EXPECT_THAT(faults("robots: {r: {poses: 'rosbridge:robot.lan/odom'" + rest),
                ElementsAre("rig.yaml:1: robots.r.poses: must be rosbridge:ws://HOST:PORT/TOPIC "
                            "such as rosbridge:ws://127.0.0.1:9090/odom, not 'robot.lan/odom'"));
}

}  // namespace
}  // namespace scipd::daemon
