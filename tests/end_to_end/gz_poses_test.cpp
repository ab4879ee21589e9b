// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner in a world that Gazebo moves: what Gazebo's transport carries, without Gazebo.
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/daemon/bridges/gz_bytes.h"
#include "tests/daemon/bridges/gz_publisher.h"
#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

constexpr const char* topic = "/world/square_room/dynamic_pose/info";

nlohmann::json source_of(const DaemonProcess& daemon) {
    return daemon.get("/status").at("poses").at("sources").at(0);
}

/// The transport loses what it sends before its sockets are connected. This says nothing, and no
/// time.
bool comes_to_hear(const DaemonProcess& daemon, GzPublisher& publisher) {
    return eventually([&] {
        publisher.write(gz_poses(std::nullopt, {{"nobody", 1}}));
        return source_of(daemon).at("messages") > 0;
    });
}

class GzPoses : public testing::Test {
  protected:
    GzPoses() { keep_gz_to_this_test(); }

    static double x_of(const DaemonProcess& daemon, const std::string& path) {
        return daemon.get(path).at("xyz").at(0);
    }

    TempDir directory_;
};

TEST_F(GzPoses, MoveRobotAndModelsOfTheWorldThatIsLoaded) {
    GzPublisher publisher(topic, "gz.msgs.Pose_V");
    const DaemonProcess daemon(directory_, on_tcp({"--accuracy", "ideal", "--poses", "gz:"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    ASSERT_TRUE(comes_to_hear(daemon, publisher));
    for (int i = 0; i < 20; ++i) {
        publisher.write(gz_poses(
            100s + i * 20ms,
            {{"robot", 20, 1.0}, {"box", 30, -1.5, 1.0}, {"link", 21, 0.0}, {"link", 31, 0.0}}));
        std::this_thread::sleep_for(20ms);
    }
    EXPECT_TRUE(eventually([&] { return wire.next_scan().distances_mm.front() == 2000U; }));
    EXPECT_TRUE(eventually([&] { return x_of(daemon, "/scene/models/box/pose") == -1.5; }));
    const auto source = source_of(daemon);
    EXPECT_EQ(source.at("source"), std::string("gz:") + topic);
    EXPECT_EQ(source.at("type"), "gz.msgs.Pose_V");
    EXPECT_TRUE(source.at("troubles").empty()) << source;
    EXPECT_EQ(daemon.get("/status").at("poses").at("refused"), 0);
}

#ifdef GZ_TOPIC
/// One message of a type that Gazebo's own program knows, from its text.
void publish(const std::string& text) {
    const std::string program = GZ_TOPIC;
    const bool is_ignition = program.find("ign-") != std::string::npos;
    const Outcome ended =
        run({program, "-t", topic, "-m", is_ignition ? "ignition.msgs.Pose_V" : "gz.msgs.Pose_V",
             "-p", text});
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
}

TEST_F(GzPoses, ComeFromGazebosOwnCommandLine) {
    const DaemonProcess daemon(directory_, on_tcp({"--accuracy", "ideal", "--poses", "gz:"}));
    int sec = 100;
    // It says nothing of whom it has reached.
    EXPECT_TRUE(eventually([&] {
        publish("header {stamp {sec: " + std::to_string(sec++) + R"(}}
            pose {name: "robot" id: 20 position {x: 1} orientation {z: 1}}
            pose {name: "box" id: 30 position {x: -1.5 y: 1} orientation {w: 1}})");
        return x_of(daemon, "/robots/robot/pose") == 1.0;
    }));
    EXPECT_TRUE(eventually([&] { return x_of(daemon, "/scene/models/box/pose") == -1.5; }));
    // It has turned to the wall behind it.
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    EXPECT_EQ(wire.next_scan().distances_mm.front(), 4000U);
    EXPECT_EQ(daemon.get("/status").at("poses").at("refused"), 0);
}
#endif

TEST_F(GzPoses, TellWhichNamesAreNotThere) {
    GzPublisher publisher(topic, "ignition.msgs.Pose_V");
    const DaemonProcess daemon(directory_, on_tcp({"--name", "rescue/front", "--poses", "gz:"}));
    ASSERT_TRUE(comes_to_hear(daemon, publisher));
    publisher.write(gz_poses(1s, {{"rescu", 20, 1.0}, {"box1", 30, 0.0}}));
    ASSERT_TRUE(eventually([&] {
        return source_of(daemon).at("messages") > 1 &&
               source_of(daemon).at("troubles").dump().find("did you") != std::string::npos;
    }));
    const auto troubles = source_of(daemon).at("troubles");
    EXPECT_EQ(troubles.at(0), "Gazebo names no 'rescue'; did you mean 'rescu'?");
    EXPECT_EQ(troubles.at(1), "Gazebo does not move model 'box'; did you mean 'box1'?");
}

/// All lines of a scanner while Gazebo runs for two seconds, pauses, and is reset.
std::vector<std::string> drive(const TempDir& directory) {
    GzPublisher publisher(topic, "gz.msgs.Pose_V");
    const DaemonProcess daemon(directory,
                               on_tcp({"--clock", "poses", "--seed", "7", "--poses", "gz:"}));
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask("BM"), "00");
    EXPECT_EQ(wire.ask("MD0000108001000"), "00");
    EXPECT_TRUE(comes_to_hear(daemon, publisher));
    std::vector<std::string> lines;
    const auto read_all = [&] {
        while (const auto scan = wire.next_message(500ms))
            lines.insert(lines.end(), scan->lines.begin(), scan->lines.end());
    };
    const auto write = [&](std::chrono::milliseconds time, double x) {
        publisher.write(gz_poses(time, {{"robot", 20, x}, {"box", 30, -1.5, x}}));
    };
    for (int i = 0; i <= 200; ++i)
        write(1000s + i * 10ms, i * 0.005);
    read_all();
    const std::size_t before = lines.size();
    // It pauses: the same time again and again, and no scan.
    for (int i = 0; i < 20; ++i)
        write(1002s, 1.0);
    read_all();
    EXPECT_EQ(lines.size(), before);
    // It is reset.
    for (int i = 0; i <= 200; ++i)
        write(i * 10ms + 10ms, 0.0);
    read_all();
    EXPECT_GT(lines.size(), before);
    return lines;
}

TEST_F(GzPoses, GiveTheSameBytesTwiceInLockstepWithAPauseAndAReset) {
    const auto first = drive(directory_);
    const auto second = drive(directory_);
    EXPECT_GE(first.size(), 100U * 34U);
    EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace scipd::tests
