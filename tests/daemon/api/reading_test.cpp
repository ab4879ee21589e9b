// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// GET /sensors/R/S/reading and truth over a camera and a ranger before a wall, and /stream.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/routes.h"
#include "daemon/clock/stepped_clock.h"
#include "daemon/device/scan_loop.h"
#include "daemon/device/sensor_record.h"
#include "daemon/device/staring_sensor.h"
#include "tests/daemon/device/ideal_camera.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/empty_api.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::HasSubstr;

/// Five pixels across a right angle and one row: the outermost look at y = 4/5 of x. The wall ends
/// at y = 5 and its face is 4 m ahead.
SensorConfig camera() {
    return ideal_camera(5, 5.0);
}

SensorConfig ranger() {
    SensorConfig config = camera();
    config.name = "sonar";
    config.staring->optics = sim::RangerOptics{{0.5, 7}, sim::Aggregate::nearest};
    return config;
}

World wall_before_sensors() {
    World world = wall_world();
    world.replace_backends(one_backend(world.scene(), {"robot/tof", "robot/sonar"}));
    return world;
}

class Socket : public WebSocket {
  public:
    void send(std::shared_ptr<const std::string> message) override { sent.push_back(*message); }
    void send_bytes(std::shared_ptr<const std::string>) override {}
    void cut() override {}

    std::vector<std::string> sent;
};

class ReadingTest : public testing::Test, protected tests::EmptyApi {
  protected:
    [[nodiscard]] std::optional<SensorRecord> latest(const std::string& sensor) override {
        if (sensor == "robot/tof") return camera_.latest();
        if (sensor == "robot/sonar") return ranger_.latest();
        return EmptyApi::latest(sensor);
    }
    [[nodiscard]] std::optional<SensorLog> log(const std::string& sensor) const override {
        if (sensor == "robot/tof") return camera_.log();
        if (sensor == "robot/sonar") return ranger_.log();
        return sensor == "robot/scanner" ? std::optional<SensorLog>(log_) : std::nullopt;
    }

    void ask_log(const std::string& sensor) override {
        if (sensor == "robot/tof") camera_.ask_log();
        if (sensor == "robot/sonar") ranger_.ask_log();
    }

    HttpResponse ask(const std::string& path, const std::string& query = {}) {
        std::optional<HttpResponse> answer;
        route(*this, {"GET", "/sensors/robot/" + path, query, ""},
              [&](const HttpResponse& response) { answer = response; });
        return answer.value();
    }
    json get(const std::string& path, const std::string& query = {}) {
        const auto response = ask(path, query);
        EXPECT_EQ(response.status, 200) << response.body;
        return json::parse(response.body);
    }
    std::string refusal(int status, const std::string& path, const std::string& query = {}) {
        const auto response = ask(path, query);
        EXPECT_EQ(response.status, status) << response.body;
        return json::parse(response.body).value("detail", "");
    }

    SteppedClock clock_;
    World world_ = wall_before_sensors();
    StaringSensor camera_{"robot", camera(), 1, world_, clock_};
    StaringSensor ranger_{"robot", ranger(), 1, world_, clock_};
    ScanLog log_;
};

TEST_F(ReadingTest, OfACameraIsAPicture) {
    clock_.advance_to(90ms);
    const json said = get("tof/reading");
    EXPECT_EQ(said["sensor"], "robot/tof");
    EXPECT_EQ(said["scan"], 2);
    EXPECT_EQ(said["time_s"], 0.08);
    EXPECT_EQ(said["pose"], json({{"xyz", {0.0, 0.0, 0.0}}, {"q", {0.0, 0.0, 0.0, 1.0}}}));
    EXPECT_EQ(said["columns"], 5);
    EXPECT_EQ(said["rows"], 1);
    ASSERT_EQ(said["range_m"].size(), 5U);
    // 4 * sqrt(1 + 0.8^2) is 5.12: too far.
    EXPECT_EQ(said["range_m"][0], nullptr);
    EXPECT_NEAR(said["range_m"][1].get<double>(), 4.0 * std::sqrt(1.16), 2e-6);
    EXPECT_NEAR(said["range_m"][2].get<double>(), 4.0, 2e-6);
    EXPECT_EQ(said["range_m"][4], nullptr);
}

TEST_F(ReadingTest, OfARangerIsOneRange) {
    const json said = get("sonar/reading");
    EXPECT_NEAR(said["range_m"].get<double>(), 4.0, 2e-6);
    EXPECT_FALSE(said.contains("columns"));
    ASSERT_TRUE(world_.place_robot("robot", {.time = 10ms, .pose = {{-2, 0, 0}, {1, 0, 0, 0}}}));
    clock_.advance_to(80ms);
    EXPECT_EQ(get("sonar/reading")["range_m"], nullptr);
}

TEST_F(ReadingTest, HasItsTruth) {
    clock_.advance_to(40ms);
    const json of_camera = get("tof/truth");
    EXPECT_EQ(of_camera["scan"], 1);
    EXPECT_EQ(of_camera["poses"].size(), 1U);
    EXPECT_EQ(of_camera["poses"][0]["time_s"], 0.04);
    EXPECT_EQ(of_camera["columns"], 5);
    EXPECT_EQ(of_camera["range_m"], get("tof/reading")["range_m"]);
    EXPECT_NEAR(of_camera["incidence_rad"][1].get<double>(), std::atan(0.4), 1e-3);
    EXPECT_EQ(of_camera["object"][2], "object 0");
    EXPECT_EQ(of_camera["material"][2], "default");
    EXPECT_EQ(of_camera["true_m"][0], nullptr);

    const json of_ranger = get("sonar/truth", "scan=1");
    ASSERT_EQ(of_ranger["true_m"].size(), 7U);
    EXPECT_NEAR(of_ranger["true_m"][6].get<double>(), 4.0 / std::cos(0.25), 1e-3);
    EXPECT_EQ(of_ranger["range_m"], of_ranger["true_m"][0]);
    EXPECT_THAT(refusal(404, "sonar/truth", "scan=0"), HasSubstr("those from 1 to 1 are"));
    EXPECT_THAT(refusal(400, "tof/truth", "n=1"), HasSubstr("scan must be the number"));
}

TEST_F(ReadingTest, IsNotOfAScanner) {
    EXPECT_EQ(refusal(404, "scanner/reading"),
              "\"robot/scanner\" is a scanner, which its driver reads over SCIP; "
              "/sensors/robot/scanner/truth tells what it saw");
    EXPECT_EQ(refusal(404, "other/reading"), "there is no sensor \"robot/other\"");
}

TEST_F(ReadingTest, IsStreamedOncePerInstant) {
    ScanLoop of_camera(camera_, clock_);
    ScanLoop of_ranger(ranger_, clock_);
    const ScanStream::Tap tap(stream(), "robot/tof", camera_);
    const ScanStream::Tap other(stream(), "robot/sonar", ranger_);
    Socket socket;
    const auto talk = stream().subscribe("robot/tof", socket);
    clock_.advance_to(130ms);
    for (int i = 0; i < 3; ++i)
        talk->left();
    ASSERT_EQ(socket.sent.size(), 3U);
    EXPECT_EQ(json::parse(socket.sent[1])["time_s"], 0.08);
    EXPECT_EQ(json::parse(socket.sent[2]), get("tof/reading"));
    EXPECT_EQ(camera_.measured(), 3U);
    EXPECT_EQ(ranger_.measured(), 0U);
}

}  // namespace
}  // namespace scipd::daemon
