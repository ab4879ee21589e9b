// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Measures the time from the start of scipd's process, in the rescue maze, to the first connection
// that it accepts, and to the first scan on it.
//
//   build/release/bin/startup_bench
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "tests/end_to_end/in_square_room.h"

namespace {

using namespace scipd::tests;
using Milliseconds = std::chrono::duration<double, std::milli>;

void print(const char* what, std::vector<Milliseconds> times) {
    std::ranges::sort(times);
    std::printf("%-32s median %6.1f ms   max %6.1f ms\n", what, times[times.size() / 2].count(),
                times.back().count());
}

}  // namespace

int main() {
    constexpr int runs = 10;
    std::vector<Milliseconds> to_connection;
    std::vector<Milliseconds> to_scan;
    for (int i = 0; i < runs; ++i) {
        const TempDir directory;
        const auto start = std::chrono::steady_clock::now();
        const DaemonProcess daemon(
            directory, {"--scene", scene("rescue_maze.sdf"), "--pose", "1,1,0", "--mount",
                        "0,0,0.25,0,0,0", "--tcp", "127.0.0.1:0"});
        ScannerWire wire = ScannerWire::tcp(daemon.port());
        to_connection.emplace_back(std::chrono::steady_clock::now() - start);
        if (wire.ask(stream_of_all_beams) != "00") return 1;
        (void)wire.next_scan();
        to_scan.emplace_back(std::chrono::steady_clock::now() - start);
    }
    print("first connection (below 300 ms)", to_connection);
    print("first scan", to_scan);
}
