// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// When a small world replaces a large one, the memory of the large one goes back to the system.
#include <fstream>
#include <sstream>
#include <string>

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

/// Balls of many triangles each. Such memory comes in pieces, which allocators like to keep.
std::string many_balls() {
    std::ostringstream text;
    text << "<sdf version='1.9'><world name='w'>";
    for (int i = 0; i < 80; ++i) {
        text << "<model name='m" << i << "'><pose>" << 10 + i % 9 * 3 << ' ' << i / 9 * 3
             << " 0 0 0 0</pose><link name='l'>";
        for (int k = 3; k < 7; ++k) {
            text << "<visual name='v" << k << "'><geometry><sphere><radius>0." << k
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

}  // namespace
}  // namespace scipd::tests
