// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd takes of the memory: a scanner little, and of a large world nothing once a small one
// has replaced it.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"
#include "tests/support/sanitized.h"

namespace scipd::tests {
namespace {

/// Resident memory, as the system counts it.
double memory_mb(pid_t pid) {
    std::ifstream status{"/proc/" + std::to_string(pid) + "/status"};
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1000;
    }
    return 0;
}

/// Balls of many triangles each, no two alike: equal ones would share their memory. It comes in
/// pieces, which allocators like to keep.
std::string many_balls() {
    std::ostringstream text;
    text << "<sdf version='1.9'><world name='w'>";
    for (int i = 0; i < 80; ++i) {
        text << "<model name='m" << i << "'><pose>" << 10 + i % 9 * 3 << ' ' << i / 9 * 3
             << " 0 0 0 0</pose><link name='l'>";
        for (int k = 3; k < 7; ++k) {
            text << "<visual name='v" << k << "'><geometry><sphere><radius>0." << k << i + 10
                 << "</radius></sphere></geometry></visual>";
        }
        text << "</link></model>";
    }
    text << "</world></sdf>";
    return text.str();
}

TEST(Memory, OfALargeWorldGoesBackWithIt) {
    if (sanitized) GTEST_SKIP() << "sanitizers keep what is given back";
    const TempDir directory;
    const std::string small = directory.path() / "small.sdf";
    std::filesystem::copy_file(scene("square_room.sdf"), small);
    const DaemonProcess daemon(directory, {"--scene", small, "--backend", "embree", "--tcp",
                                           "127.0.0.1:0", "--pty", "none"});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    const auto load = [&](const std::string& file) {
        const nlohmann::json body{{"file", file}};
        const auto answer = control_request(daemon.control(), "PUT", "/scene", body.dump());
        EXPECT_EQ(answer.status, 200) << answer.body;
    };
    const std::string large = directory.write("large.sdf", many_balls());
    const double fresh_mb = memory_mb(daemon.pid());
    for (int round = 0; round < 2; ++round) {
        load(large);
        // scipd keeps a scan of the large world, but none of the world's memory for it.
        auto wire = ScannerWire::tcp(daemon.port());
        EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
        (void)wire.next_scan();
        EXPECT_GT(memory_mb(daemon.pid()), fresh_mb + 150) << "too small a world to tell anything";
        load(small);
        EXPECT_TRUE(eventually([&] { return memory_mb(daemon.pid()) < fresh_mb + 50; }))
            << fresh_mb << " MB at first, " << memory_mb(daemon.pid()) << " MB now";
    }
}

/// So many scanners on a robot that drives for a second and a half, each with a client.
double memory_of_driving_mb(int scanners) {
    const TempDir directory;
    std::string config = "clock: poses\nscene: " + scene("square_room.sdf").string() +
                         "\nrobots:\n  robot:\n    poses: '-'\n    sensors:\n";
    for (int i = 0; i < scanners; ++i)
        config += "      s" + std::to_string(i) + ": {model: UST-10LX, tcp: 127.0.0.1:0}\n";
    const DaemonProcess daemon(directory, {"--config", directory.write("rig.yaml", config)});
    std::vector<ScannerWire> clients;
    for (int i = 0; i < scanners; ++i) {
        clients.push_back(ScannerWire::tcp(daemon.port(static_cast<std::size_t>(i))));
        EXPECT_EQ(clients.back().ask(stream_of_one_beam), "00");
    }
    for (int i = 0; i <= 75; ++i) {
        const std::string seconds = std::to_string(i / 50.0);
        daemon.say(R"({"xyz":[)" + seconds + R"(,0,0.3],"t":)" + seconds + "}\n");
    }
    EXPECT_TRUE(eventually([&] { return daemon.get("/status").at("time_s") >= 1.48; }));
    EXPECT_GE(daemon.sensor_status().at("scans"), 50);
    return memory_mb(daemon.pid());
}

// The scans of a second alone would be 4 MB.
TEST(Memory, OfAScannerThatDrivesIsSmall) {
    if (sanitized) GTEST_SKIP() << "sanitizers take memory of their own";
    const double few_mb = memory_of_driving_mb(20);
    EXPECT_LT((memory_of_driving_mb(100) - few_mb) / 80, 0.3);
}

}  // namespace
}  // namespace scipd::tests
