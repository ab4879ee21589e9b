// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A camera and rangers of a running scipd, 3 m before the wall of the square room: over HTTP on the
// control socket, over WebSockets, and with scipctl.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/child.h"
#include "tests/support/control_request.h"
#include "tests/support/sanitized.h"

namespace scipd::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

// The pillar and the box of the room are to the back and to the side. Up to 20 degrees from the
// axis, at this height, there is only the wall x = 3.
std::string robots(const std::string& backend, const std::string& more = {}) {
    return "scene: " + scene("square_room.sdf").string() + R"(
seed: 5
)" + more + R"(
robots:
  robot:
    sensors:
      scanner: {model: UST-10LX, pty: auto}
      tof:
        camera: {columns: 16, rows: 5, fov_deg: [30, 6], rate_hz: 25, range_m: [0.1, 7.5],
                 noise: {sigma_m: 0.01}}
        mount: {xyz: [0, 0, 0.3]}
        accuracy: ideal
        backend: )" +
           backend + R"(
      sonar:
        ranger: {cone_deg: 10, beams: 31, rate_hz: 20, range_m: [0.02, 4.0], aggregate: weighted}
        mount: {xyz: [0, 0, 0.5]}
        accuracy: ideal
      blind:
        ranger: {cone_deg: 10, beams: 31, rate_hz: 20, range_m: [0.02, 2.0], noise: {sigma_m: 0.01}}
        mount: {xyz: [0, 0, 0.5]}
)";
}

void expect_wall(const json& picture) {
    ASSERT_EQ(picture.at("columns"), 16);
    ASSERT_EQ(picture.at("rows"), 5);
    ASSERT_EQ(picture.at("range_m").size(), 80U);
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 16; ++column) {
            const double y = std::tan(15 * degree) * (15 - 2 * column) / 16.0;
            const double z = std::tan(3 * degree) * (4 - 2 * row) / 5.0;
            EXPECT_NEAR(picture.at("range_m").at(static_cast<std::size_t>(row * 16 + column)),
                        3.0 * std::sqrt(1 + y * y + z * z), 1e-3)
                << row << ", " << column;
        }
    }
}

bool lacks_egl(const std::string& error) {
    return error.find("EGL") != error.npos || error.find("OpenGL") != error.npos;
}

class Staring : public testing::Test {
  protected:
    void start(const std::string& text) {
        daemon_.emplace(directory_, Arguments{"--config", directory_.write("rig.yaml", text)});
        ASSERT_NE(daemon_->ready_line(), "") << daemon_->standard_error();
    }
    [[nodiscard]] json reading(const std::string& sensor) const {
        return daemon_->get("/sensors/robot/" + sensor + "/reading");
    }
    [[nodiscard]] Outcome scipctl(std::vector<std::string> words) const {
        words.insert(words.begin(), {SCIPCTL, "--control", daemon_->control()});
        return run(words);
    }

    TempDir directory_;
    std::optional<DaemonProcess> daemon_;
};

TEST_F(Staring, IsReadOverTheControlApi) {
    start(robots("embree"));
    expect_wall(reading("tof"));
    const json sonar = reading("sonar");
    EXPECT_EQ(sonar.at("sensor"), "robot/sonar");
    EXPECT_EQ(sonar.at("pose").at("xyz"), json({0.0, 0.0, 0.5}));
    EXPECT_GE(sonar.at("range_m"), 3.0 - 1e-3);
    EXPECT_LE(sonar.at("range_m"), 3.0 / std::cos(5 * degree));
    EXPECT_EQ(reading("blind").at("range_m"), nullptr);
    const json truth = daemon_->get("/sensors/robot/sonar/truth");
    EXPECT_EQ(truth.at("true_m").size(), 31U);
    EXPECT_NEAR(truth.at("true_m").at(0), 3.0, 1e-3);
    EXPECT_NEAR(truth.at("true_m").at(30), 3.0 / std::cos(5 * degree), 1e-3);
    EXPECT_EQ(control_request(daemon_->control(), "GET", "/sensors/robot/scanner/reading").status,
              404);
}

TEST_F(Staring, IsTheSameByDepthBuffer) {
    start(robots("reference"));
    const json by_rays = reading("tof");
    expect_wall(by_rays);
    daemon_.reset();
    const auto file = directory_.write("rig.yaml", robots("depth"));
    daemon_.emplace(directory_, Arguments{"--config", file});
    if (daemon_->ready_line().empty() && lacks_egl(daemon_->standard_error())) {
        GTEST_SKIP() << daemon_->standard_error();
    }
    ASSERT_NE(daemon_->ready_line(), "") << daemon_->standard_error();
    EXPECT_EQ(daemon_->sensor_status(1).at("backend"), "depth");
    expect_wall(reading("tof"));
}

TEST_F(Staring, IsListedWithoutAWire) {
    start(robots("embree"));
    const json ready = json::parse(daemon_->ready_line());
    ASSERT_EQ(ready.at("sensors").size(), 4U);
    EXPECT_EQ(
        ready.at("sensors").at(1),
        json({{"name", "robot/tof"}, {"model", "camera"}, {"tcp", nullptr}, {"pty", nullptr}}));
    EXPECT_EQ(ready.at("sensors").at(2).at("model"), "ranger");
    const json tof = daemon_->get("/sensors/robot/tof");
    EXPECT_EQ(tof.at("model"), "camera");
    EXPECT_EQ(tof.at("backend"), "embree");
    EXPECT_EQ(tof.at("state"), "standby");
    EXPECT_EQ(tof.at("tcp"), nullptr);
    EXPECT_EQ(tof.at("pty"), nullptr);
    EXPECT_EQ(tof.at("scans"), 0);
    EXPECT_EQ(tof, daemon_->sensor_status(1));
}

TEST_F(Staring, StreamsEveryInstantAndRestsWhenNobodyLooks) {
    if (sanitized)
        GTEST_SKIP() << "a sanitized scipd does not make 25 pictures of a camera a second";
    start(robots("embree"));
    {
        WebSocketClient socket(daemon_->control(), "/stream?sensor=robot/tof");
        json last = json::parse(socket.receive());
        expect_wall(last);
        for (int i = 0; i < 5; ++i) {
            const json next = json::parse(socket.receive());
            EXPECT_EQ(next.at("scan").get<std::int64_t>(), last.at("scan").get<std::int64_t>() + 1);
            EXPECT_NEAR(next.at("time_s").get<double>(), last.at("time_s").get<double>() + 0.04,
                        1e-9);
            last = next;
        }
        EXPECT_EQ(daemon_->sensor_status(1).at("state"), "measuring");
    }
    EXPECT_TRUE(eventually([&] { return daemon_->sensor_status(1).at("state") == "standby"; }));
    EXPECT_EQ(daemon_->sensor_status(2).at("scans"), 0);
    // One stream carries all sensors.
    WebSocketClient all(daemon_->control(), "/stream");
    bool picture = false;
    bool scan = false;
    bool range = false;
    for (int i = 0; i < 40 && !(picture && scan && range); ++i) {
        const json message = json::parse(all.receive());
        picture |= message.contains("columns");
        scan |= message.contains("sent_mm");
        range |= message.contains("range_m") && !message.contains("columns");
    }
    EXPECT_TRUE(picture && scan && range);
}

TEST_F(Staring, FollowsItsRobot) {
    start(robots("embree"));
    EXPECT_EQ(
        control_request(daemon_->control(), "PUT", "/robots/robot/pose", R"({"xyz":[1.5,0,0]})")
            .status,
        204);
    EXPECT_TRUE(eventually([&] { return reading("blind").at("range_m") != nullptr; }));
    EXPECT_TRUE(eventually([&] { return reading("sonar").at("range_m") < 1.6; }));
    EXPECT_NEAR(reading("sonar").at("range_m"), 1.5, 0.01);
}

TEST_F(Staring, IsShownByScipctl) {
    start(robots("embree"));
    EXPECT_THAT(scipctl({"sensors"}).out, HasSubstr("robot/sonar    ranger    "));
    const json said = json::parse(scipctl({"reading", "robot/tof", "--json"}).out);
    expect_wall(said);
    EXPECT_THAT(scipctl({"reading", "robot/tof"}).out,
                HasSubstr(" s: 16 x 5 pixels, 80 see something, the nearest at 3.00"));
    EXPECT_THAT(scipctl({"reading", "robot/sonar"}).out, HasSubstr(" s: 3.00"));
    EXPECT_THAT(scipctl({"reading", "robot/blind"}).out, HasSubstr(" s: nothing in range\n"));
    EXPECT_THAT(scipctl({"truth", "robot/sonar"}).out,
                HasSubstr("\nBEAM  TRUE m  SAYS m  INCIDENCE rad  MATERIAL"));
    const Outcome refused = scipctl({"reading", "robot/scanner"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("which its driver reads over SCIP"));
    EXPECT_THAT(scipctl({"reading", "robot/x"}).err,
                HasSubstr("there is no sensor \"robot/x\"; there are: robot/scanner, robot/tof"));
}

/// All messages of a stream during a drive in lockstep.
std::vector<std::string> drive(const TempDir& directory) {
    const auto file =
        directory.write("lockstep.yaml", robots("embree", "clock: poses") + "    poses: \"-\"\n");
    const DaemonProcess daemon(directory, Arguments{"--config", file});
    EXPECT_NE(daemon.ready_line(), "") << daemon.standard_error();
    WebSocketClient camera(daemon.control(), "/stream?sensor=robot/tof");
    WebSocketClient ranger(daemon.control(), "/stream?sensor=robot/blind");
    EXPECT_TRUE(eventually([&] { return daemon.sensor_status(3).at("state") == "measuring"; }));
    std::vector<std::string> said;
    for (int i = 0; i <= 101; ++i) {
        const std::string t = std::to_string(1000.0 + 0.01 * i);
        const std::string x = std::to_string(0.5 + 0.01 * i);
        daemon.say("{\"t\":" + t + ",\"xyz\":[" + x + ",0,0]}\n");
        // The box of the room could move as well, so scipd waits for the next stamp before it
        // advances to this one.
        const int done = i - 1;
        if (done > 0 && done % 4 == 0) said.push_back(camera.receive());
        if (done > 0 && done % 5 == 0) said.push_back(ranger.receive());
    }
    return said;
}

TEST_F(Staring, IsTheSameInEveryRunInLockstep) {
    const std::vector<std::string> first = drive(directory_);
    EXPECT_EQ(first.size(), 45U);
    EXPECT_EQ(drive(directory_), first);
    const json last = json::parse(first.back());
    EXPECT_EQ(last.at("time_s"), 1001.0);
    EXPECT_NEAR(last.at("pose").at("xyz").at(0), 1.5, 1e-9);
    EXPECT_NEAR(last.at("range_m"), 1.5, 0.06);
    EXPECT_NE(last.at("range_m"), 1.5);
}

}  // namespace
}  // namespace scipd::tests
