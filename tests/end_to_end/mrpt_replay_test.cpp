// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// MRPT's driver gets a recording as it was written, from its first scan on, although the driver
// comes long after scipd: JSON lines of this test's own, whose ranges are known.
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/mrpt_driver.h"

namespace scipd::tests {
namespace {

constexpr int replayed_scans = 40;
constexpr int no_distance = 65533;  // of a UST

int replayed_mm(int scan, int step) {
    return (step + scan) % 17 == 0 ? no_distance : 500 + (step * 7 + scan * 131) % 9000;
}

std::string replayed_lines() {
    std::string lines;
    for (int scan = 0; scan < replayed_scans; ++scan) {
        nlohmann::json line{{"host_time_s", 1'700'000'000.0 + 0.025 * scan},
                            {"stamp_ms", 25 * scan},
                            {"model", "UST-10LX"},
                            {"first_step", 0}};
        for (int step = 0; step < ust_10lx.beams(); ++step)
            line["distances_mm"].push_back(replayed_mm(scan, step));
        lines += line.dump() + "\n";
    }
    return lines;
}

TEST(MrptDriverOfAReplay, GetsEachScanFromTheFirstOn) {
    const TempDir directory;
    const auto file = directory.write("made.jsonl", replayed_lines());
    const DaemonProcess daemon(directory, {"--replay", file.string(), "--tcp", "127.0.0.1:0"});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    MrptDriver driver(daemon, Link::tcp);
    for (int scan = 0; scan < replayed_scans; ++scan) {
        const MrptDriver::Scan got = driver.next_scan();
        expect_shape(got, ust_10lx);
        for (int step = 0; step < ust_10lx.beams(); ++step) {
            const auto beam = static_cast<std::size_t>(step);
            const int mm = replayed_mm(scan, step);
            ASSERT_EQ(got.getScanRangeValidity(beam), mm != no_distance) << scan << ": " << step;
            const double range_m = mm == no_distance ? 0.0 : got.getScanRange(beam);
            ASSERT_NEAR(range_m, mm == no_distance ? 0.0 : mm / 1000.0, 1e-6)
                << scan << ": " << step;
        }
    }
}

}  // namespace
}  // namespace scipd::tests
