// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Poses in and scans out over WebSockets of a running scipd.
#include <csignal>
#include <cstdint>
#include <string>

#include <boost/system/system_error.hpp>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using nlohmann::json;

class WebSockets : public testing::Test {
  protected:
    WebSockets() { EXPECT_NE(daemon_.ready_line(), "") << daemon_.standard_error(); }

    TempDir directory_;
    DaemonProcess daemon_{directory_, on_tcp()};
};

TEST_F(WebSockets, PosesMoveTheRobot) {
    WebSocketClient socket(daemon_.control(), "/poses");
    // A message may hold several lines. scipd does not answer valid ones.
    socket.send("{\"xyz\":[0.5,0,0]}\n\n# nothing\n{\"xyz\":[1,0,0]}\n");
    socket.send("{\"t\":1}");
    json refusal = json::parse(socket.receive());
    EXPECT_EQ(refusal.at("status"), 400);
    EXPECT_EQ(refusal.at("detail"), "xyz is missing");
    EXPECT_EQ(refusal.at("field"), "xyz");
    EXPECT_EQ(refusal.at("line"), 5);
    socket.send("{\"model\":\"nobody\",\"xyz\":[1,0,0]}");
    refusal = json::parse(socket.receive());
    EXPECT_EQ(refusal.at("field"), "model");
    EXPECT_EQ(daemon_.get("/robots/robot/pose").at("xyz"), json({1.0, 0.0, 0.0}));
    const auto poses = daemon_.get("/status").at("poses");
    EXPECT_EQ(poses.at("accepted"), 2);
    EXPECT_EQ(poses.at("refused"), 2);
}

// The wall ahead is at 3 m.
TEST_F(WebSockets, AStreamCastsWithoutADriver) {
    WebSocketClient all(daemon_.control(), "/stream");
    json scan = json::parse(all.receive());
    EXPECT_EQ(scan.at("sensor"), "robot/scanner");
    EXPECT_EQ(scan.at("first_step"), 0);
    EXPECT_EQ(scan.at("front_step"), 540);
    EXPECT_EQ(scan.at("steps_per_turn"), 1440);
    EXPECT_EQ(scan.at("sent_mm").size(), 1081U);
    EXPECT_EQ(scan.at("intensity").size(), 1081U);
    EXPECT_EQ(scan.at("sent_mm").at(540), 3000);
    EXPECT_EQ(scan.at("pose").at("xyz").at(2), 0.3);
    WebSocketClient one(daemon_.control(), "/stream?sensor=robot%2Fscanner");
    const std::int64_t other = json::parse(one.receive()).at("scan");
    (void)daemon_.get("/sensors/robot/scanner/truth");  // from now on it keeps a second
    for (int i = 0; i < 20; ++i) {
        const json next = json::parse(all.receive());
        EXPECT_EQ(next.at("scan").get<std::int64_t>(), scan.at("scan").get<std::int64_t>() + 1);
        scan = next;
    }
    EXPECT_LE(other, scan.at("scan").get<std::int64_t>());
    const auto truth = daemon_.get("/sensors/robot/scanner/truth?scan=" + scan.at("scan").dump());
    EXPECT_EQ(truth.at("sent_mm"), scan.at("sent_mm"));
    EXPECT_EQ(truth.at("stamp_ms"), scan.at("stamp_ms"));
}

TEST_F(WebSockets, NothingIsCastWhenTheLastHasGone) {
    {
        WebSocketClient socket(daemon_.control(), "/stream");
        (void)socket.receive();
    }
    const auto latest = [&] {
        return daemon_.get("/sensors/robot/scanner/truth").at("scan").get<std::int64_t>();
    };
    EXPECT_TRUE(eventually([&] {
        const std::int64_t before = latest();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return latest() == before;
    }));
}

TEST_F(WebSockets, OneWhoDoesNotReadLosesScansAndHoldsNobodyUp) {
    WebSocketClient slow(daemon_.control(), "/stream");
    ScannerWire wire = ScannerWire::tcp(daemon_.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    const auto lost = [&] { return daemon_.sensor_status().at("stream_lost").get<int>(); };
    while (lost() == 0) {
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    EXPECT_EQ(daemon_.sensor_status().at("lost"), 0) << "the driver got all";
    // Queued messages come whole and in order.
    std::int64_t last = -1;
    for (int i = 0; i < 16; ++i) {
        const std::int64_t number = json::parse(slow.receive()).at("scan");
        EXPECT_GT(number, last);
        last = number;
    }
}

TEST_F(WebSockets, ALongMessageOfRubbishIsAnsweredOnceAndHoldsNobodyUp) {
    ScannerWire wire = ScannerWire::tcp(daemon_.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    WebSocketClient poses(daemon_.control(), "/poses");
    std::string rubbish;
    for (int i = 0; i < 500'000; ++i)
        rubbish += "x\n";
    poses.send(rubbish);
    const auto refused = [&] {
        return daemon_.get("/status").at("poses").at("refused").get<int>();
    };
    while (refused() < 500'000) {
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    const json answer = json::parse(poses.receive());
    EXPECT_EQ(answer.at("line"), 1);
    EXPECT_EQ(answer.at("refused"), 500'000);
    poses.send("y");
    EXPECT_EQ(json::parse(poses.receive()).at("line"), 500'001);
}

TEST_F(WebSockets, AreRefusedWhereThereAreNone) {
    for (const char* path : {"/status", "/poses/x", "/stream?sensor=no/body", "/stream?x=1"}) {
        EXPECT_THROW(WebSocketClient(daemon_.control(), path), boost::system::system_error) << path;
    }
}

TEST_F(WebSockets, EndWithTheDaemon) {
    WebSocketClient poses(daemon_.control(), "/poses");
    WebSocketClient scans(daemon_.control(), "/stream");
    (void)scans.receive();
    daemon_.signal(SIGTERM);
    EXPECT_EQ(daemon_.wait(), 0);
    EXPECT_THROW(for (;;)(void) scans.receive(), boost::system::system_error);
}

}  // namespace
}  // namespace scipd::tests
