// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner on a robot that is moved by ROS 2 over Cyclone DDS.
#include <chrono>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/daemon/bridges/cyclone_publisher.h"
#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

// A chain of frames over both topics. What holds for good was said before scipd came.
TEST(CyclonePoses, MoveTheRobotByTransforms) {
    const auto domain = 100U + static_cast<unsigned>(getpid() % 100);
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    setenv("ROS_DOMAIN_ID", std::to_string(domain).c_str(), 1);
    CyclonePublisher fixed(domain, "/tf_static", true);
    fixed.write({{.parent = "base", .child = "base_link", .x = 0.25},
                 {.parent = "base_link", .child = "laser", .x = 7.0}});
    CyclonePublisher moving(domain, "/tf", false);
    const TempDir directory;
    const DaemonProcess daemon(directory, on_tcp({"--accuracy", "ideal", "--poses", "ros2:/tf"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    EXPECT_EQ(wire.next_scan().distances_mm.front(), 3000U);
    int sec = 100;
    EXPECT_TRUE(eventually([&] {
        moving.write({{.sec = sec++, .parent = "odom", .child = "base", .x = 0.75}});
        return wire.next_scan().distances_mm.front() == 2000U;
    }));
    const auto source = daemon.get("/status").at("poses").at("sources").at(0);
    EXPECT_EQ(source.at("type"), "tf2_msgs/TFMessage");
    EXPECT_TRUE(source.at("troubles").empty()) << source;
}

}  // namespace
}  // namespace scipd::tests
