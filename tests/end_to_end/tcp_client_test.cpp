// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// TCP clients may connect at any time, leave in any way, and wait for each other.
#include <chrono>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/client/driver.h"
#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

class TcpClient : public testing::Test {
  protected:
    [[nodiscard]] ScannerWire connect() const { return ScannerWire::tcp(daemon_.port()); }

    TempDir directory_;
    DaemonProcess daemon_{directory_, on_tcp()};
};

TEST_F(TcpClient, IsBelievedByTheProjectsOwnDriver) {
    ScannerWire wire = connect();
    protocol::client::Driver driver(wire);
    driver.connect();
    // The number of a UST of that year.
    EXPECT_THAT(driver.version().serial, testing::MatchesRegex("H16[0-9]{5}"));
    driver.start({.first_step = 0, .last_step = 1080});
    std::optional<std::uint32_t> stamp_ms;
    for (int i = 0; i < 20; ++i) {
        const auto scan = driver.next_scan();
        EXPECT_EQ(scan.distances_mm[540], 3000U);
        EXPECT_EQ(scan.distances_mm[900], 2000U);
        if (stamp_ms) {
            EXPECT_EQ(turns_between(*stamp_ms, scan.stamp_ms), 1);
        }
        stamp_ms = scan.stamp_ms;
    }
    driver.stop();
    EXPECT_EQ(driver.damaged_scans(), 0U);
}

TEST_F(TcpClient, MayGoInAnyWayAtAnyMoment) {
    for (int i = 0; i < 30; ++i) {
        ScannerWire wire = connect();
        if (i % 3 != 0) {
            EXPECT_EQ(wire.ask(stream_of_all_beams), "00");
        }
        if (i % 3 == 2) (void)wire.next_scan();
        if (i % 2 == 0) wire.write("MD00");
        i % 4 < 2 ? wire.close() : wire.abort();
    }
    ScannerWire wire = connect();
    EXPECT_EQ(wire.ask("VV"), "00");
    // What the other clients began ended with them.
    protocol::client::Driver driver(wire);
    EXPECT_EQ(driver.state().laser, "OFF");
}

TEST_F(TcpClient, GetsItsAnswersAfterClosingItsSide) {
    ScannerWire wire = connect();
    wire.write("VV\nPP\n");
    wire.half_close();
    for (const char* request : {"VV", "PP"}) {
        const auto answer = wire.next_message();
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->echo, request);
        EXPECT_FALSE(answer->damage);
    }
    EXPECT_TRUE(wire.ends());
}

TEST_F(TcpClient, EndsItsStreamByClosingItsSide) {
    ScannerWire wire = connect();
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    wire.half_close();
    EXPECT_TRUE(wire.ends());
    EXPECT_TRUE(eventually([&] { return daemon_.sensor_status().at("clients") == 0; }));
    EXPECT_EQ(daemon_.sensor_status().at("state"), "standby");
}

TEST_F(TcpClient, WaitsUntilTheOneBeforeHasGone) {
    ScannerWire first = connect();
    EXPECT_EQ(first.ask(stream_of_one_beam), "00");
    ScannerWire second = connect();
    second.write("VV\n");
    EXPECT_FALSE(second.next_message(300ms));
    (void)first.next_scan();
    EXPECT_EQ(first.ask("QT"), "00");
    EXPECT_FALSE(second.next_message(100ms));

    first.close();
    const auto answer = second.next_message();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->echo, "VV");
}

TEST_F(TcpClient, CausesNoScansWithoutAsking) {
    const auto scans = [&] { return daemon_.sensor_status().at("scans").get<int>(); };
    ScannerWire wire = connect();
    EXPECT_EQ(wire.ask("BM"), "00");
    // The laser is on, but no client has asked for scans.
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(scans(), 0);
    EXPECT_TRUE(daemon_.sensor_status().at("lateness_ms").at("max").is_null());

    EXPECT_EQ(wire.ask("MD0540054000005"), "00");
    for (int left = 4; left >= 0; --left)
        EXPECT_EQ(wire.next_scan().request.scans, left);
    std::this_thread::sleep_for(200ms);
    EXPECT_EQ(scans(), 5);
}

}  // namespace
}  // namespace scipd::tests
