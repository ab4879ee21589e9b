// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// GET /sensors/R/S/truth over a real device before a wall whose ranges are closed form.
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "daemon/api/measurement_text.h"
#include "daemon/api/routes.h"
#include "daemon/clock/stepped_clock.h"
#include "daemon/device/device.h"
#include "tests/daemon/wall_world.h"
#include "tests/support/empty_api.h"
#include "tests/support/one_backend.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::HasSubstr;

class TruthTest : public testing::Test, tests::EmptyApi {
  protected:
    [[nodiscard]] std::optional<SensorLog> log(const std::string& sensor) const override {
        return sensor == "robot/scanner" ? std::optional<SensorLog>(device_.log()) : std::nullopt;
    }
    void ask_log(const std::string& /*sensor*/) override { device_.ask_log(); }

    HttpResponse ask(const std::string& query = {}) {
        std::optional<HttpResponse> answer;
        route(*this, {"GET", "/sensors/robot/scanner/truth", query, ""},
              [&](const HttpResponse& response) { answer = response; });
        return answer.value();
    }
    json truth(const std::string& query = {}) {
        const auto response = ask(query);
        EXPECT_EQ(response.status, 200) << response.body;
        return json::parse(response.body);
    }
    std::string refusal(int status, const std::string& query = {}) {
        const auto response = ask(query);
        EXPECT_EQ(response.status, status) << response.body;
        return json::parse(response.body).value("detail", "");
    }

    void turn(int times = 1) {
        for (int i = 0; i < times; ++i) {
            clock_.advance_to(device_.leaves(revolution_));
            device_.turn_complete(revolution_++);
        }
    }

    static SensorConfig in_three_fans() {
        SensorConfig config = ideal_sensor();
        config.motion = 3;
        return config;
    }

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", in_three_fans(), 1, world_, clock_};
    std::unique_ptr<Endpoint::Client> client_ = device_.connect([] {}, protocol::LinkKind::network);
    std::int64_t revolution_ = device_.next_revolution();
};

// A UST-10LX: 1081 steps of a quarter of a degree from 0, the front at 540.
TEST_F(TruthTest, IsWhatTheWorldHasAndWhatWasSent) {
    client_->receive("MD0000108000000\n");
    turn();
    const json said = truth();
    EXPECT_EQ(said["sensor"], "robot/scanner");
    EXPECT_EQ(said["scan"], revolution_ - 1);
    const double start_s = said["time_s"];
    EXPECT_EQ(said["stamp_ms"], static_cast<int>(std::floor(start_s * 1000 + 1e-6)));
    ASSERT_EQ(said["poses"].size(), 1U);
    EXPECT_EQ(said["poses"][0]["xyz"], json({0.0, 0.0, 0.0}));
    EXPECT_EQ(said["poses"][0]["q"], json({0.0, 0.0, 0.0, 1.0}));
    EXPECT_EQ(said["accuracy"], "ideal");
    for (const char* list : {"steps", "true_m", "object", "material", "incidence_rad", "sent_mm",
                             "intensity", "read_m", "cause"})
        EXPECT_EQ(said[list].size(), 1081U) << list;

    EXPECT_EQ(said["steps"][540], 540);
    for (const int step : {540, 440, 640}) {
        const double angle = (step - 540) * 0.25 * std::numbers::pi / 180.0;
        const double range_m = 4.0 / std::cos(angle);
        EXPECT_NEAR(said["true_m"][step], range_m, 2e-6);
        EXPECT_NEAR(said["incidence_rad"][step], std::abs(angle), 1e-3);
        EXPECT_EQ(said["object"][step], "object 0");
        EXPECT_EQ(said["material"][step], "default");
        EXPECT_EQ(said["sent_mm"][step], std::lround(range_m * 1000.0));
        EXPECT_NEAR(said["read_m"][step], range_m, 2e-6);
        EXPECT_EQ(said["cause"][step], "measured");
        EXPECT_GT(said["intensity"][step], 0);
    }
    // Behind it there is nothing.
    for (const char* list : {"true_m", "object", "material", "incidence_rad"})
        EXPECT_EQ(said[list][0], nullptr) << list;
    EXPECT_EQ(said["sent_mm"][0], device_.profile().codes.nothing);
    EXPECT_EQ(said["read_m"][0], nullptr);
    EXPECT_EQ(said["cause"][0], "nothing");
    // Geometry knows no echoes.
    EXPECT_FALSE(said.contains("echoes"));
    EXPECT_FALSE(said.contains("sent_echoes_mm"));
}

// A UTM-30LX-EW looks through a pane 2 m ahead at a black wall 4 m ahead; its front step is 540. No
// distance is read of the wall 4 m ahead that is black enough.
TEST_F(TruthTest, HasTheEchoesOfAScannerThatSeesLight) {
    const sim::SharedScene scene =
        sim::SceneBuilder()
            .add(sim::Box{{0.01, 1.0, 1.0}}, {{2.005, 0, 0}, {1, 0, 0, 0}}, 1)
            .add(sim::Box{{1.0, 20.0, 20.0}}, {{4.5, 0, 0}, {1, 0, 0, 0}}, 2)
            .build();
    sim::MaterialLibrary library;
    library.add({.name = "material 1",
                 .reflectance = {{905, 0.04}},
                 .specular = 0.9,
                 .gloss = 2000,
                 .transmission = 0.9});
    library.add({.name = "material 2", .reflectance = {{905, 0.001}}});
    world_.replace_scene(scene, one_backend(scene));
    world_.light().set_materials(std::make_shared<const sim::MaterialLibrary>(library));
    SensorConfig config = ideal_sensor("UTM-30LX-EW");
    config.accuracy = sim::Accuracy::material;
    Device device{"robot", config, 1, world_, clock_};
    client_ = device.connect([] {}, protocol::LinkKind::network);
    client_->receive("ND0540054000000\n");
    const std::int64_t revolution = device.next_revolution();
    clock_.advance_to(device.leaves(revolution));
    device.turn_complete(revolution);
    const json said = json::parse(truth_text("robot/scanner", *device.log().latest()));
    EXPECT_EQ(said["accuracy"], "material");
    ASSERT_EQ(said["echoes"].size(), 1081U);
    const json& ahead = said["echoes"][540];
    ASSERT_EQ(ahead.size(), 2U) << ahead;
    EXPECT_NEAR(ahead[0]["range_m"], 2.0, 0.01);
    EXPECT_EQ(ahead[0]["object"], "object 0");
    EXPECT_EQ(ahead[0]["material"], "material 1");
    EXPECT_NEAR(ahead[1]["range_m"], 4.0, 1e-3);
    EXPECT_EQ(ahead[1]["material"], "material 2");
    EXPECT_GT(ahead[0]["power"], ahead[1]["power"]);
    EXPECT_EQ(said["sent_echoes_mm"][540].size(), 1U);
    EXPECT_EQ(said["sent_echoes_mm"][540][0], said["sent_mm"][540]);
    EXPECT_EQ(said["sent_echoes_intensity"][540], json({said["intensity"][540]}));
    // Beside the pane the wall is all that there is.
    EXPECT_EQ(said["cause"][740], "too_dark");
    EXPECT_EQ(said["read_m"][740], nullptr);
    EXPECT_EQ(said["echoes"][0], json::array());
    EXPECT_EQ(said["cause"][0], "nothing");
    client_.reset();  // before its device
}

// The curve is so steep that the range which was read has another bias.
TEST_F(TruthTest, HasTheBiasOfTheTrueRange) {
    for (const auto accuracy : {sim::Accuracy::sensor, sim::Accuracy::material}) {
        SensorConfig config = ideal_sensor();
        config.accuracy = accuracy;
        config.model.own_bias = true;
        config.model.optics.bias = {{0.0, 0.0}, {10.0, 1.0}};
        config.model.optics.receiver.walk_m = 0.0;
        Device device{"robot", config, 1, world_, clock_};
        client_ = device.connect([] {}, protocol::LinkKind::network);
        client_->receive("MD0540054000000\n");
        const std::int64_t revolution = device.next_revolution();
        clock_.advance_to(device.leaves(revolution));
        device.turn_complete(revolution);
        const json said = json::parse(truth_text("robot/scanner", *device.log().latest()));
        EXPECT_NEAR(said["true_m"][540], 4.0, 1e-5);
        EXPECT_NEAR(said["read_m"][540], 4.4, 0.03);
        EXPECT_NEAR(said["bias_m"][540], 0.4, 1e-4) << static_cast<int>(accuracy);
        client_.reset();  // before its device
    }
}

// Step 0 looks behind, where there is nothing; a fault such as `dirty` gives it a range all the
// same.
TEST_F(TruthTest, HasNoBiasWhereABeamMetNothing) {
    for (const auto accuracy : {sim::Accuracy::sensor, sim::Accuracy::material}) {
        SensorConfig config = ideal_sensor();
        config.accuracy = accuracy;
        config.model.own_bias = true;
        config.model.optics.bias = {{0.0, 0.0}, {10.0, 1.0}};
        Device device{"robot", config, 1, world_, clock_};
        client_ = device.connect([] {}, protocol::LinkKind::network);
        client_->receive("MD0540054000000\n");
        const std::int64_t revolution = device.next_revolution();
        clock_.advance_to(device.leaves(revolution));
        device.turn_complete(revolution);
        ScanRecord record = *device.log().latest();
        sim::Scan scan = *record.cast;
        for (const float signal : {0.0F, 0.5F}) {
            scan.readings[0] = {.range_m = 2.0F, .signal = signal, .cause = sim::Cause::measured};
            record.cast = std::make_shared<const sim::Scan>(scan);
            const json said = json::parse(truth_text("robot/scanner", record));
            EXPECT_EQ(said["true_m"][0], nullptr);
            EXPECT_EQ(said["bias_m"][0], nullptr) << said["bias_m"][0];
            EXPECT_EQ(said["read_m"][0], 2.0);
            EXPECT_EQ(said["cause"][0], "measured");
            EXPECT_TRUE(said["bias_m"][540].is_number());
        }
        client_.reset();  // before its device
    }
}

// A scanner plays what it is given: step 0 has a range of 2 m, all others are without an echo.
TEST_F(TruthTest, IsUnknownWhereTheScannerPlaysARecording) {
    for (const auto accuracy :
         {sim::Accuracy::ideal, sim::Accuracy::sensor, sim::Accuracy::material}) {
        SensorConfig config = ideal_sensor();
        config.accuracy = accuracy;
        config.model.own_bias = true;
        config.model.optics.bias = {{0.0, 0.0}, {10.0, 1.0}};
        Device device{"robot", config, 1, world_, clock_};
        const auto tape = std::make_shared<Tape>(1081, false);
        TapedScan taped{.distance = std::vector<std::uint32_t>(1081, 65533),
                        .intensity = std::vector<std::uint32_t>(1081, 0),
                        .echoes = {}};
        taped.distance[0] = 2000;
        taped.intensity[0] = 321;
        tape->add(taped, 7, {});
        tape->end(25ms);
        device.play(track_of(tape), {.files = {"/home/lap.mcap"}});
        client_ = device.connect([] {}, protocol::LinkKind::network);
        client_->receive("MD0000108000000\n");
        const std::int64_t revolution = device.next_revolution();
        clock_.advance_to(device.leaves(revolution));
        device.turn_complete(revolution);
        const json said = json::parse(truth_text("robot/scanner", *device.log().latest()));
        EXPECT_EQ(said["backend"], "recording");
        EXPECT_THAT(std::string(said["backend_reason"]), HasSubstr("plays /home/lap.mcap"));
        EXPECT_EQ(said["sent_mm"], json(taped.distance));
        EXPECT_EQ(said["intensity"], json(taped.intensity));
        EXPECT_EQ(said["read_m"][0], 2.0);
        for (const char* list : {"true_m", "object", "material", "incidence_rad"})
            EXPECT_EQ(said[list], json(std::vector<json>(1081))) << list;
        EXPECT_EQ(said.contains("bias_m"), accuracy != sim::Accuracy::ideal);
        EXPECT_EQ(said.value("bias_m", said["true_m"]), said["true_m"]);
        client_.reset();  // before its device
    }
}

// From the origin to the left at 1 m/s.
TEST_F(TruthTest, HasAPoseForEachFan) {
    (void)world_.place_robot("robot", {.time = 0s, .pose = {}});
    (void)world_.place_robot("robot", {.time = 500ms, .pose = {{0, 0.5, 0}, {1, 0, 0, 0}}});
    client_->receive("MD0540054000000\n");
    turn(2);
    const json poses = truth()["poses"];
    ASSERT_EQ(poses.size(), 3U);
    for (const json& pose : poses)
        EXPECT_NEAR(pose["xyz"][1].get<double>(), pose["time_s"].get<double>(), 1e-9);
    // A third of 1081 of 1440 steps in 25 ms.
    const double between_s = poses[1]["time_s"].get<double>() - poses[0]["time_s"].get<double>();
    EXPECT_NEAR(between_s, 0.025 * 1081 / 1440 / 3, 0.025 / 1440);
}

// In lockstep people have the stamps of their poses for times.
TEST_F(TruthTest, TellsTimesFromTheOriginOfItsClock) {
    client_->receive("MD0540054000000\n");
    turn();
    const json before = truth();
    clock_.set_origin(1'000'000s);
    turn();
    const json said = truth();
    const double turn_s = said["time_s"].get<double>() - before["time_s"].get<double>() - 1e6;
    EXPECT_NEAR(turn_s, 0.025, 1e-3);
    EXPECT_NEAR(said["poses"][0]["time_s"].get<double>() - said["time_s"].get<double>(),
                before["poses"][0]["time_s"].get<double>() - before["time_s"].get<double>(), 1e-6);
    // What was told is not told otherwise later.
    EXPECT_EQ(truth("scan=" + std::to_string(revolution_ - 2)), before);
}

TEST_F(TruthTest, KeepsASecondOfScans) {
    client_->receive("MD0540054000000\n");
    turn();
    (void)truth();
    turn(100);
    const std::int64_t last = revolution_ - 1;
    // 25 ms each: 40 turns before the last one is a second ago.
    EXPECT_EQ(truth("scan=" + std::to_string(last - 40))["scan"], last - 40);
    EXPECT_EQ(truth("scan=" + std::to_string(last))["scan"], last);
    const std::string kept = "from " + std::to_string(last - 40) + " to " + std::to_string(last);
    EXPECT_THAT(refusal(404, "scan=" + std::to_string(last - 41)), HasSubstr(kept));
    EXPECT_THAT(refusal(404, "scan=" + std::to_string(last + 1)), HasSubstr(kept));
}

// Scans are large, and most scanners are never asked for their truth.
TEST_F(TruthTest, KeepsScansForAMinuteFromAQuestionOn) {
    EXPECT_THAT(refusal(404), HasSubstr("no scan yet"));
    client_->receive("MD0540054000000\n");
    const auto kept = [&] { return device_.log().last() - device_.log().first() + 1; };
    clock_.advance_to(70s);
    revolution_ = device_.next_revolution();
    turn(3);
    EXPECT_EQ(kept(), 1) << "nobody has asked of late";
    const std::string before = std::to_string(revolution_ - 2);
    EXPECT_THAT(refusal(404, "scan=" + before), HasSubstr("request a later scan"));
    turn(2);
    EXPECT_EQ(truth("scan=" + std::to_string(revolution_ - 2))["scan"], revolution_ - 2);
    const sim::Time asked = clock_.now();
    while (device_.leaves(revolution_) < asked + 60s)
        turn();
    EXPECT_EQ(kept(), 41);
    turn();
    EXPECT_EQ(kept(), 1);
}

TEST_F(TruthTest, KeepsTheNamesOfTheirWorld) {
    client_->receive("MD0540054000000\n");
    turn();
    const sim::SharedScene other = sim::SceneBuilder()
                                       .add(sim::Box{{1, 1, 1}}, {{-9, 0, 0}, {1, 0, 0, 0}})
                                       .add(sim::Box{{1, 1, 1}}, {{2.5, 0, 0}, {1, 0, 0, 0}})
                                       .build();
    const std::weak_ptr<const sim::Scene> before = world_.scene();
    world_.replace_scene(other, one_backend(other));
    EXPECT_TRUE(before.expired()) << "which may be large";
    EXPECT_EQ(truth()["object"][540], "object 0");
    turn();
    EXPECT_EQ(truth()["object"][540], "object 1");
    EXPECT_EQ(truth()["sent_mm"][540], 2000);
    EXPECT_EQ(truth("scan=" + std::to_string(revolution_ - 2))["object"][540], "object 0");
}

TEST_F(TruthTest, SaysWhatToDoWhereThereIsNone) {
    EXPECT_THAT(refusal(404), HasSubstr("only scans while someone reads"));
    client_->receive("MD0540054000000\n");
    turn();
    for (const char* query : {"scan=", "scan=x", "scan=1x", "scan=99999999999999999999", "n=1"})
        EXPECT_THAT(refusal(400, query), HasSubstr("scan must be the number")) << query;
}

}  // namespace
}  // namespace scipd::daemon
