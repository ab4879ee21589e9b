// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// /status tells the state into which clients have brought a scanner.
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

class Status : public testing::Test {
  protected:
    /// Starts a scanner of this model and opens a client on its tty.
    void start(const std::string& model) {
        daemon_.emplace(directory_, on_tty({"--model", model}));
        wire_.emplace(ScannerWire::tty(daemon_->tty()));
    }
    [[nodiscard]] std::string state() const {
        return daemon_->sensor_status().at("state").get<std::string>();
    }
    /// The answer to this request and the scanner's state after it.
    std::string after(const std::string& request) {
        const std::string status = wire_->ask(request);
        return status + " " + state();
    }

    TempDir directory_;
    std::optional<DaemonProcess> daemon_;
    std::optional<ScannerWire> wire_;
};

TEST_F(Status, FollowsLaserStreamAndTimeAdjust) {
    start("UST-10LX");
    EXPECT_EQ(state(), "standby");
    EXPECT_EQ(after("BM"), "00 measuring");
    EXPECT_EQ(after(stream_of_one_beam), "00 streaming");
    EXPECT_EQ(after("QT"), "00 standby");
    EXPECT_EQ(after("TM0"), "00 time adjust");
    EXPECT_EQ(after("TM2"), "00 standby");
}

TEST_F(Status, TellsThatTheMotorIsStopped) {
    start("UST-10LX");
    EXPECT_EQ(after("%SL"), "00 asleep");
    EXPECT_EQ(after("BM"), "00 measuring");
}

TEST_F(Status, TellsTrouble) {
    start("URG-04LX@3.3.00");
    EXPECT_EQ(after("DB02"), "00 error");
    EXPECT_EQ(after("DB10"), "00 standby");
}

// A UST begins to boot a second after the second RB, and takes 10 s.
TEST_F(Status, TellsThatItBoots) {
    start("UST-10LX");
    EXPECT_EQ(wire_->ask("RB"), "01");
    EXPECT_EQ(after("RB"), "00 standby");
    EXPECT_TRUE(eventually([&] { return state() == "booting"; }));
}

TEST_F(Status, TellsThatItIsFoundColdAndThenReady) {
    const auto file = directory_.write("cold.yaml", "scene: " + scene("square_room.sdf").string() +
                                                        R"(
robots:
  robot:
    sensors:
      scanner: {model: UTM-30LX-EW, pty: auto, power_up: boot}
)");
    daemon_.emplace(directory_, Arguments{"--config", file});
    EXPECT_EQ(state(), "booting");
    EXPECT_TRUE(eventually([&] { return state() == "standby"; }));
}

}  // namespace
}  // namespace scipd::tests
