// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

TEST(SlowReader, LosesWholeScansAndDelaysNobody) {
    const TempDir directory;
    const auto config =
        directory.write("two.yaml", "scene: " + scene("square_room.sdf").string() + R"(
robots:
  rescue:
    sensors:
      front: {model: UST-10LX, tcp: "127.0.0.1:0"}
      rear: {model: UST-10LX, tcp: "127.0.0.1:0"}
)");
    const DaemonProcess daemon(directory, {"--config", config});
    const auto lost = [&] { return daemon.sensor_status(0).at("lost").get<std::uint32_t>(); };

    ScannerWire slow = ScannerWire::tcp(daemon.port(0), 4096);
    // A scan with intensity is 6.6 kB.
    EXPECT_EQ(slow.ask("ME0000108000000"), "00");
    ScannerWire quick = ScannerWire::tcp(daemon.port(1));
    EXPECT_EQ(quick.ask(stream_of_all_beams), "00");

    // The quick one reads all the time and misses no scan.
    std::uint32_t stamp_ms = quick.next_scan().stamp_ms;
    for (int scans = 1; scans < 4000 && (scans % 20 != 0 || lost() < 10); ++scans) {
        const std::uint32_t next_ms = quick.next_scan().stamp_ms;
        ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    ASSERT_GE(lost(), 10U);
    EXPECT_EQ(daemon.sensor_status(1).at("lost"), 0);

    // The slow one gets whole scans in order, and more of them than without a queue.
    std::optional<std::uint32_t> before_ms;
    std::uint32_t missing = 0;
    int scans = 0;
    while (missing == 0 && scans < 4000) {
        const auto scan = slow.next_scan();
        ASSERT_EQ(scan.distances_mm.size(), 1081U);
        ASSERT_EQ(scan.intensities.size(), 1081U);
        if (before_ms) {
            ASSERT_GT(scan.stamp_ms, *before_ms);
            missing = static_cast<std::uint32_t>(turns_between(*before_ms, scan.stamp_ms) - 1);
        }
        before_ms = scan.stamp_ms;
        ++scans;
    }
    EXPECT_GT(scans, 40);
    EXPECT_GT(missing, 0U);
    EXPECT_LE(missing, lost());
    EXPECT_EQ(slow.ask("QT"), "00");
}

}  // namespace
}  // namespace scipd::tests
