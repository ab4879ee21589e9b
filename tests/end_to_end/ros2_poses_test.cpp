// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner on a robot that is moved by ROS 2, of which another vendor's DDS stands here.
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/daemon/bridges/fast_dds_publisher.h"
#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

class Ros2Poses : public testing::Test {
  protected:
    Ros2Poses() {
        setenv("ROS_LOCALHOST_ONLY", "1", 1);
        setenv("ROS_DOMAIN_ID", std::to_string(domain_).c_str(), 1);
    }

    static void wait_for_subscriber(const FastDdsPublisher& publisher) {
        ASSERT_TRUE(eventually([&] { return publisher.subscribers() == 1; }));
    }

    static WrittenTransform at(std::chrono::milliseconds time, double x) {
        return {.sec = static_cast<std::int32_t>(time / 1s),
                .nanosec = static_cast<std::uint32_t>(time % 1s / 1ns),
                .parent = "odom",
                .child = "base_link",
                .xyz_q = {x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}};
    }

    static nlohmann::json source_of(const DaemonProcess& daemon) {
        return daemon.get("/status").at("poses").at("sources").at(0);
    }

    // Tests that run side by side do not hear each other.
    int domain_ = 100 + static_cast<int>(getpid() % 100);
    TempDir directory_;
};

TEST_F(Ros2Poses, MoveTheRobotByOdometry) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const DaemonProcess daemon(directory_,
                               on_tcp({"--accuracy", "ideal", "--poses", "ros2:/odom"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    EXPECT_EQ(wire.next_scan().distances_mm.front(), 3000U);
    wait_for_subscriber(publisher);
    for (int i = 0; i < 20; ++i) {
        publisher.write(odometry_bytes(at(100s + i * 20ms, 1.0), std::vector<double>(6)));
        std::this_thread::sleep_for(20ms);
    }
    EXPECT_TRUE(eventually([&] { return wire.next_scan().distances_mm.front() == 2000U; }));
    const auto source = source_of(daemon);
    EXPECT_EQ(source.at("source"), "ros2:/odom");
    EXPECT_EQ(source.at("type"), "nav_msgs/Odometry");
    EXPECT_EQ(source.at("messages"), 20);
    EXPECT_TRUE(source.at("troubles").empty());
    // A message that is damaged is counted, and changes nothing.
    publisher.write(std::string("\0\1\0\0damaged", 11));
    EXPECT_TRUE(eventually([&] { return source_of(daemon).at("refused") == 1; }));
    EXPECT_EQ(wire.next_scan().distances_mm.front(), 2000U);
}

/// All bytes of a scanner for a drive of two seconds in lockstep.
std::vector<std::string> drive(
    const TempDir& directory, int domain,
    const std::function<WrittenTransform(std::chrono::milliseconds, double)>& at) {
    FastDdsPublisher publisher(domain, "/tf", "tf2_msgs/TFMessage");
    const DaemonProcess daemon(directory,
                               on_tcp({"--clock", "poses", "--seed", "7", "--poses", "ros2:/tf"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask("BM"), "00");
    EXPECT_EQ(wire.ask("MD0000108001000"), "00");
    EXPECT_TRUE(eventually([&] { return publisher.subscribers() == 1; }));
    for (int i = 0; i <= 200; ++i)
        publisher.write(transforms_bytes({at(1000s + i * 10ms, i * 0.005)}));
    std::vector<std::string> scans;
    // The laser takes a moment to settle; then a scan ends each 25 ms.
    for (int i = 0; i < 70; ++i) {
        const auto scan = wire.next_message(5s);
        if (!scan) break;
        scans.insert(scans.end(), scan->lines.begin(), scan->lines.end());
    }
    return scans;
}

TEST_F(Ros2Poses, GiveTheSameBytesTwiceInLockstep) {
    const auto first = drive(directory_, domain_, at);
    const auto second = drive(directory_, domain_, at);
    // A scan has 34 lines at least, and the first answer none.
    EXPECT_GE(first.size(), 69U * 34U);
    EXPECT_EQ(first, second);
}

TEST_F(Ros2Poses, CostNoScanAtAThousandMessagesASecond) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const DaemonProcess daemon(directory_, on_tcp({"--poses", "ros2:/odom"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    wait_for_subscriber(publisher);
    std::thread sender([&] {
        for (int i = 1; i <= 2000; ++i) {
            publisher.write(odometry_bytes(at(100s + i * 1ms, i * 1e-4), std::vector<double>(6)));
            std::this_thread::sleep_for(1ms);
        }
    });
    for (int i = 0; i < 80; ++i)
        (void)wire.next_scan();
    sender.join();
    EXPECT_TRUE(eventually([&] { return source_of(daemon).at("messages") == 2000; }));
    EXPECT_EQ(source_of(daemon).at("lost"), 0);
    EXPECT_EQ(daemon.sensor_status().at("lost"), 0);
}

TEST_F(Ros2Poses, TellWhatIsNotThere) {
    FastDdsPublisher publisher(domain_, "/odom", "nav_msgs/Odometry");
    const DaemonProcess daemon(directory_, on_tcp({"--poses", "ros2:/odm"}));
    ASSERT_TRUE(eventually([&] { return !source_of(daemon).at("troubles").empty(); }));
    const std::string trouble =
        "no publisher of /odm; did you mean '/odom'? (ROS domain " + std::to_string(domain_) + ')';
    EXPECT_EQ(source_of(daemon).at("troubles").at(0), trouble);
    const Outcome shown = run({SCIPCTL, "--control", daemon.control(), "pose", "sources"});
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_NE(shown.out.find("warning: robot: " + trouble), std::string::npos) << shown.out;
    EXPECT_NE(daemon.standard_error().find(trouble), std::string::npos);
}

}  // namespace
}  // namespace scipd::tests
