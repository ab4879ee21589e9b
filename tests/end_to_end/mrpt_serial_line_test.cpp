// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// MRPT's driver on a real serial line. It finds a URG-04LX at the 19200 bit/s of power-up, asks it
// for 115200, changes its own end, and receives right scans at that rate. The test does without the
// firmware's tick of 100 ms: MRPT waits no longer than that, so with the tick each step would be a
// matter of luck. The scanner turns slowly, because a scan takes 185 ms on the line. Otherwise the
// first scan would begin while MRPT still waits 100 ms after the acknowledgement; at some phases of
// the mirror it does all the same, and MRPT reads on for ever.
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <mrpt/hwdrivers/CHokuyoURG.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "tests/support/daemon_process.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using mrpt::hwdrivers::CHokuyoURG;
using Scan = mrpt::obs::CObservation2DRangeScan;

std::filesystem::path with_serial_line(const TempDir& directory) {
    return directory.write("line.yaml", "scene: " + scene("square_room.sdf").string() + R"(
robots:
  robot:
    sensors:
      scanner:
        model: URG-04LX
        mount: {xyz: [0, 0, 0.3]}
        accuracy: ideal
        timing: ideal
        profile: {scan_rpm: 240, scan_period_ms: 250}
        pty: auto
        tcp: 127.0.0.1:0
        clock: {phase_ms: 0}
        link: {baud: 19200}
)");
}

std::optional<Scan> next_scan(CHokuyoURG& driver) {
    Scan scan;
    // A call that gets no scan takes 100 ms.
    for (int attempt = 0; attempt < 50; ++attempt) {
        bool there = false;
        bool failed = false;
        driver.doProcessSimple(there, scan, failed);
        if (failed) return std::nullopt;
        if (there) return scan;
    }
    return std::nullopt;
}

std::string report_of_state(ScannerWire& wire) {
    wire.write("II\n");
    const auto message = wire.next_message();
    std::string lines;
    for (const std::string& line : message.value().lines)
        lines += line + "\n";
    return lines;
}

void expect_room(const Scan& scan) {
    ASSERT_EQ(scan.getScanSize(), 682U);
    // The first step that is sent is 44. Step 384 looks ahead, where the wall is 3 m away. A
    // quarter turn to either side it is 2 m away.
    EXPECT_NEAR(scan.getScanRange(384 - 44), 3.0, 0.0015);
    EXPECT_NEAR(scan.getScanRange(384 - 44 - 256), 2.0, 0.0015);
    EXPECT_NEAR(scan.getScanRange(384 - 44 + 256), 2.0, 0.0015);
}

/// False: an answer took longer than MRPT's 100 ms, as may happen on a busy machine.
bool changes_the_rate_and_sees_the_room() {
    const TempDir directory;
    const DaemonProcess daemon(directory, {"--config", with_serial_line(directory)});
    ScannerWire beside = ScannerWire::tcp(daemon.port());
    EXPECT_NE(report_of_state(beside).find("SBPS:19200[bps]<-Default setting by user\n"),
              std::string::npos);
    CHokuyoURG driver;
    driver.setVerbosityLevel(mrpt::system::LVL_ERROR);
    driver.setSerialPort(daemon.tty());
    // It is private in CHokuyoURG but public in its base.
    static_cast<mrpt::hwdrivers::CGenericSensor&>(driver).initialize();
    for (int i = 0; i < 3; ++i) {
        const auto scan = next_scan(driver);
        if (!scan) return false;
        expect_room(*scan);
    }
    EXPECT_NE(report_of_state(beside).find("SBPS:115200[bps]\n"), std::string::npos);
    return true;
}

TEST(MrptDriverOnASerialLine, ChangesTheRateAndSeesTheRoom) {
    constexpr int attempts = 8;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        if (changes_the_rate_and_sees_the_room()) return;
    }
    FAIL() << "it has seen no room in " << attempts << " attempts";
}

}  // namespace
}  // namespace scipd::tests
