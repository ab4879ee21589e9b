// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A model that a user has defined, and one that a user has changed, as a driver sees them.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/client/driver.h"
#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

/// It has half the steps of a UST-20LX, and its range is too short for the wall 3 m ahead.
std::string two_scanners() {
    return R"(robots:
  rescue:
    sensors:
      front: {model: MY-SCANNER, tcp: "127.0.0.1:0", mount: {xyz: [0, 0, 0.3]}, accuracy: ideal}
      rear: {model: MY-SCANNER, tcp: "127.0.0.1:0", mount: {xyz: [0, 0, 0.3]}, accuracy: ideal,
             profile: {serial: X0000002, dmax_mm: 4000, unknown_command: 0E}}
models:
  MY-SCANNER:
    like: UST-20LX
    vendor: A. User
    product: Their own scanner
    firmware: 0.1
    serial: X0000001
    model: MINE
    dmax_mm: 2900
    ares: 720
    amax: 540
    afrt: 270
    last_step: 540
    codes: {nothing: 7, too_far: 8}
scene: )" + scene("square_room.sdf").string() +
           "\n";
}

class OwnModel : public testing::Test {
  protected:
    [[nodiscard]] ScannerWire connect(std::size_t sensor) const {
        return ScannerWire::tcp(daemon_.port(sensor));
    }

    TempDir directory_;
    DaemonProcess daemon_{directory_,
                          {"--config", directory_.write("own.yaml", two_scanners()).string()}};
};

TEST_F(OwnModel, SaysWhatItsUserWantsItToSay) {
    const auto ready = nlohmann::json::parse(daemon_.ready_line());
    EXPECT_EQ(ready.at("sensors").at(0).at("model"), "MY-SCANNER");
    ScannerWire wire = connect(0);
    protocol::client::Driver driver(wire);
    driver.connect();
    const auto version = driver.version();
    EXPECT_EQ(version.vendor, "A. User");
    EXPECT_EQ(version.product, "Their own scanner");
    EXPECT_EQ(version.firmware, "0.1");
    EXPECT_EQ(version.protocol, "SCIP 2.2");  // from the UST-20LX
    EXPECT_EQ(version.serial, "X0000001");
    const auto parameters = driver.parameters();
    EXPECT_EQ(parameters.model, "MINE");
    EXPECT_EQ(parameters.dmin_mm, 20);
    EXPECT_EQ(parameters.dmax_mm, 2900);
    EXPECT_EQ(parameters.ares, 720);
    EXPECT_EQ(parameters.amax, 540);
    EXPECT_EQ(parameters.afrt, 270);
}

TEST_F(OwnModel, SeesWithTheOpticsThatFollow) {
    for (const auto& [sensor, ahead] : {std::pair{0, 7U}, std::pair{1, 3000U}}) {
        ScannerWire wire = connect(sensor);
        protocol::client::Driver driver(wire);
        driver.connect();
        driver.start({.first_step = 0, .last_step = 540});
        const auto scan = driver.next_scan();
        ASSERT_EQ(scan.distances_mm.size(), 541U);
        EXPECT_EQ(scan.distances_mm[270], ahead) << sensor;
        EXPECT_EQ(scan.distances_mm[450], 2000U) << sensor;
    }
}

TEST_F(OwnModel, IsChangedForOneScannerAlone) {
    ScannerWire front = connect(0);
    ScannerWire rear = connect(1);
    EXPECT_EQ(front.ask("ZZ"), "0F");
    EXPECT_EQ(rear.ask("ZZ"), "0E");
    protocol::client::Driver driver(rear);
    driver.connect();
    EXPECT_EQ(driver.version().serial, "X0000002");
    EXPECT_EQ(driver.version().vendor, "A. User");
    EXPECT_EQ(driver.parameters().dmax_mm, 4000);
}

TEST(OwnModelCheck, TellsAllFaultsOfModelsAndProfilesAtOnce) {
    const TempDir directory;
    const auto file = directory.write("broken.yaml", R"(models:
  MINE: {like: UST-20LX, ares: 1000, codes: {nothing: 500}, scan_rpm: 600}
  UTM-30LX: {like: UST-20LX}
robots:
  rescue:
    sensors:
      front:
        model: URG-04LX
        tcp: "127.0.0.1:0"
        profile: {serail: X1, motor_levels: perhaps, amin: 400}
        clock: {ppm: 1e6}
        link: {baud: 19200, jitter_ms: 1}
)");
    DaemonProcess daemon(directory, {"--check", file.string()});
    EXPECT_EQ(daemon.wait(), 2);
    EXPECT_EQ(daemon.standard_output(), "");
    const auto at = [&](const std::string& rest) { return file.string() + ":" + rest + "\n"; };
    const std::string front = "robots.rescue.sensors.front.";
    EXPECT_EQ(
        daemon.standard_error(),
        at("2: models.MINE.amax: must be at most 999, below ares, not 1080") +
            at("2: models.MINE.last_step: must be at most 999, below ares, not 1080") +
            at("2: models.MINE.scan_period_ms: must be within 5 % of what scan_rpm says, "
               "100 ms") +
            at("2: models.MINE.codes: nothing 500 is a distance: use one below nearest_mm or "
               "above dmax_mm") +
            at("3: models.UTM-30LX: is a model of scipd's own; use another name") +
            at("10: " + front + "profile.serail: unknown key; did you mean serial?") +
            at("10: " + front + "profile.motor_levels: must be true or false, not 'perhaps'") +
            at("10: " + front + "profile.amin: must be at most 384, afrt, not 400") +
            at("11: " + front + "clock.ppm: must lie within 10000 ppm, not '1e6'") +
            at("12: " + front +
               "link.jitter_ms: must not exceed latency_ms: nothing arrives "
               "before it is sent") +
            at("12: " + front + "link.baud: is of a tty; give pty, or leave it out"));
}

}  // namespace
}  // namespace scipd::tests
