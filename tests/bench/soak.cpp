// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A stream of 40 scans a second from a running scipd, for minutes: none may be missing or damaged.
// At the end the daemon itself tells how late its scans left.
//
//   build/release/bin/soak [MINUTES]
#include <chrono>
#include <cstdint>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "tests/end_to_end/in_square_room.h"

namespace {

using namespace scipd::tests;

constexpr std::uint32_t period_ms = 25;
constexpr std::uint32_t clock_mask = 0xffffff;  // 24 bits

/// Throws on a scan that is damaged or does not come.
int count_missing(ScannerWire& wire, long scans) {
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    int missing = 0;
    for (long i = 1; i < scans; ++i) {
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        const std::uint32_t step_ms = (next_ms - stamp_ms) & clock_mask;
        const long turns = turns_between(0, step_ms);
        if (turns != 1) {
            std::printf("after %ld scans: %u ms instead of %u\n", i, step_ms, period_ms);
            missing += static_cast<int>(turns) - 1;
        }
        stamp_ms = next_ms;
    }
    return missing;
}

int soak(double minutes) {
    const TempDir directory;
    // Moving for the first minute, on the spot after that.
    const DaemonProcess daemon(
        directory, {"--scene", scene("rescue_maze.sdf"), "--pose", "1,1,0", "--mount",
                    "0,0,0.25,0,0,0", "--poses", scene("rescue_maze.tum"), "--tcp", "127.0.0.1:0"});
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    if (wire.ask(stream_of_all_beams) != "00") return 1;
    const auto scans = static_cast<long>(minutes * 60'000.0 / period_ms);
    const int missing = count_missing(wire, scans);
    const auto status = daemon.sensor_status();
    std::printf("%ld scans in %.1f minutes, %d missing, %d lost by the daemon's own count\n", scans,
                minutes, missing, status.at("lost").get<int>());
    const auto late = status.at("lateness_ms");
    std::printf("late by p50 %.3f ms, p99 %.3f ms, max %.3f ms\n", late.at("p50").get<double>(),
                late.at("p99").get<double>(), late.at("max").get<double>());
    return missing == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    double minutes = 10.0;
    CLI::App app("Streams 40 scans a second from scipd and looks for gaps.", "soak");
    app.add_option("MINUTES", minutes, "how long")
        ->check(CLI::Range(0.01, 24.0 * 60.0))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        return soak(minutes);
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
