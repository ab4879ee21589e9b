// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What MRPT's driver does with each configuration of scenes/faults/, and beside a scanner that goes
// wrong. The first comment of each file says the same.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "tests/end_to_end/mrpt_faults.h"
#include "tests/end_to_end/square_room.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

/// Whether a range lies where nothing is: between two things that are far apart.
bool between(double range_m, int beam) {
    double nearest_m = 1e9;
    double farthest_m = 0.0;
    for (int by = -4; by <= 4; ++by) {
        const double true_m = range_in_square_room({}, utm_30lx.bearing_rad(beam + by));
        nearest_m = std::min(nearest_m, true_m);
        farthest_m = std::max(farthest_m, true_m);
    }
    return range_m > nearest_m + 0.15 && range_m < farthest_m - 0.15;
}

/// How many turns a scanner has not told of until `stop`.
int missed_turns(std::uint16_t port, const std::stop_token& stop) {
    ScannerWire wire = ScannerWire::tcp(port);
    (void)wire.ask("BM");
    (void)wire.ask("MD0000108010000");
    int missed = 0;
    std::uint32_t last_ms = wire.next_scan().stamp_ms;
    while (!stop.stop_requested()) {
        const std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
        missed += static_cast<int>(std::lround((stamp_ms - last_ms) / 25.05)) - 1;
        last_ms = stamp_ms;
    }
    return missed;
}

TEST_F(MrptFaultsTest, TakesNoCodeForARange) {
    start_configuration(scene("faults") / "codes_by_cause.yaml");
    for (const auto& [link, sensor] : {std::pair{Link::tcp, 0U}, std::pair{Link::tty, 1U}}) {
        const auto scan = connect(link, sensor)->next_scan();
        int codes = 0;
        for (std::size_t beam = 0; beam < scan.getScanSize(); ++beam) {
            const bool code = scan.getScanRange(beam) < 0.0195F;
            EXPECT_EQ(scan.getScanRangeValidity(beam), !code);
            codes += code ? 1 : 0;
        }
        EXPECT_GT(codes, 0);
    }
}

TEST_F(MrptFaultsTest, LeavesScip11ByItself) {
    start_configuration(scene("faults") / "starts_in_scip11.yaml");
    (void)connect(Link::tcp);
    (void)connect(Link::tty);
}

TEST_F(MrptFaultsTest, NeverFindsAnotherBaudRate) {
    start_configuration(scene("faults") / "wrong_baud_rate.yaml");
    MrptDriver driver(*daemon_, Link::tty);
    expect_no_scan(driver, std::chrono::seconds(2));
}

TEST_F(MrptFaultsTest, TakesRangesBeyond30Metres) {
    start_configuration(scene("faults") / "beyond_30_m.yaml");
    const auto scan = connect(Link::tcp)->next_scan();
    const std::size_t ahead = scan.getScanSize() / 2;
    EXPECT_TRUE(scan.getScanRangeValidity(ahead));
    EXPECT_NEAR(scan.getScanRange(ahead), 45.0, 0.3);
}

TEST_F(MrptFaultsTest, TakesPointsBetweenThingsForThings) {
    start_configuration(scene("faults") / "between_objects.yaml");
    const auto driver = connect(Link::tcp);
    int found = 0;
    for (int i = 0; i < 20; ++i) {
        const auto scan = driver->next_scan();
        for (int beam = 4; beam < utm_30lx.beams() - 4; ++beam) {
            if (scan.getScanRangeValidity(beam) && between(scan.getScanRange(beam), beam)) ++found;
        }
    }
    EXPECT_GT(found, 10);
}

TEST_F(MrptFaultsTest, LosesOneOfTwoScannersAndNoScanOfTheOther) {
    start_configuration(scene("two_robots.yaml"));
    constexpr std::size_t rescue_front = 0;
    constexpr std::size_t scout_front = 2;
    const auto driver = connect(Link::tcp, rescue_front);
    int missed = -1;
    std::jthread other([&](const std::stop_token& stop) {
        missed = missed_turns(daemon_->port(scout_front), stop);
    });
    run("one_of_two_scanners.yaml");
    const Seen seen = watch_until_over(*driver);
    EXPECT_TRUE(seen.silent);
    expect_scans(*driver);
    other.request_stop();
    other.join();
    EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace scipd::tests
