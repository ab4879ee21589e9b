// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is saved is read as what was running, by the reader of all configurations.
#include "daemon/config/saved_config.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "daemon/config/reading_errors.h"
#include "daemon/config/values.h"
#include "sim/loaders/file/plain_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

class SavedConfig : public testing::Test {
  protected:
    SavedConfig() { dir_.write("world.sdf", ""); }

    /// As it is read from elsewhere.
    Config again(const Config& config) const {
        return load_config(dir_.write("saved.yaml", saved_config(config, "world.sdf")));
    }

    /// But for what depends on where the text stands.
    void expect_same(const Config& config) const {
        Config before = config;
        Config after = again(config);
        if (!before.scene.empty()) before.scene = dir_.path() / "world.sdf";
        for (Config* const each : {&before, &after}) {
            each->file.clear();
            each->document.clear();
            each->places.clear();
            each->allow.clear();
            each->control.clear();
            each->geometry = {};
            each->map = {};
            for (RobotConfig& robot : each->robots) {
                robot.pose_given = true;
                for (SensorConfig& sensor : robot.sensors)
                    level(sensor.robot_from_sensor);
                level(robot.world_from_robot);
            }
        }
        EXPECT_EQ(before.robots, after.robots) << saved_config(config, "world.sdf");
        before.robots.clear();
        after.robots.clear();
        EXPECT_EQ(before, after) << saved_config(config, "world.sdf");
    }

    const tests::TempDir dir_;

  private:
    /// Angles go out and come in by sines: the last bits of a rotation differ.
    static void level(sim::Pose& pose) {
        glm::dquat& q = pose.rotation;
        if (q.w < 0.0) q = -q;
        for (double* const number : {&q.x, &q.y, &q.z, &q.w})
            *number = std::round(*number * 1e9) / 1e9 + 0.0;
    }
};

TEST_F(SavedConfig, IsReadAsWhatWasRunning) {
    int configurations = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path{SCIPD_SOURCES} / "scenes")) {
        if (entry.path().extension() != ".yaml") continue;
        // Others are scenarios, maps and materials.
        const std::string text = sim::read_file(entry.path(), 1 << 20, "");
        if (text.find("\nrobots:") == std::string::npos) continue;
        SCOPED_TRACE(entry.path());
        expect_same(load_config(entry.path()));
        ++configurations;
    }
    EXPECT_GE(configurations, 8);
}

TEST_F(SavedConfig, KeepsWhatTheFileSaysOfModelsAndLines) {
    dir_.write("walk.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
    const Config config = parse_config(R"(
scene: world.sdf
limits: {world_load_s: 77, poses_per_s: 5}
models: {MINE: {like: UST-20LX, serial: X0000001}}
robots:
  a:
    poses: {from: walk.tum, after: extrapolate, speed: 2, loop: true}
    sensors:
      one: &scanner
        model: MINE
        mount: {xyz: [0.1, -0.2, 0.3], rpy: [0.1, -0.2, 3]}
        tcp: 127.0.0.1:0
        clock: {ppm: 50, start_ms: 5}
        link: {latency_ms: 2, jitter_ms: 1}
        profile: {dmax_mm: 15000}
        bias: [{range_m: 1, bias_m: 0.01}, {range_m: 9, bias_m: 0.03}]
  b:
    pose: {xyz: [1, 2, 3], rpy: [0, 0, 1.5]}
    sensors:
      two: *scanner
      eye: {camera: {columns: 8, rows: 6, fov_deg: [40, 30], rate_hz: 25, range_m: [0.1, 7.5]}}
)",
                                       dir_.path() / "rig.yaml");
    expect_same(config);
}

TEST_F(SavedConfig, SaysWhatHoldsNow) {
    Config config = parse_config(R"(
scene: world.sdf
robots:
  a: {sensors: {one: &scanner {model: UST-10LX, tcp: "127.0.0.1:0"}, two: *scanner}}
)",
                                 dir_.path() / "rig.yaml");
    RobotConfig& robot = config.robots[0];
    robot.world_from_robot = sim::pose_from_rpy({4.0, 5.0, 6.0}, {0.3, -1.2, 2.5});
    robot.sensors[0].accuracy = sim::Accuracy::material;
    robot.sensors[0].noise = 2.5;
    config.media = {sim::fog(20.0), sim::rain(5.0)};
    config.media[1].low_m = {0.0, 0.0, 0.0};
    config.media[1].high_m = {3.0, 2.0, 1.0};
    config.clock = ClockKind::poses;
    config.seed = 18446744073709551615U;
    expect_same(config);
    EXPECT_EQ(again(config).robots[0].sensors[1].accuracy, sim::Accuracy::sensor);
}

TEST_F(SavedConfig, SaysWhatOptionsHaveSaid) {
    Config config;
    config.scene = dir_.path() / "world.sdf";
    SensorConfig scanner{.name = "scanner", .model = parse_model("URG-04LX").value()};
    scanner.robot_from_sensor = sim::pose_from_rpy({0.1, 0.0, 0.2}, {3.14159, 0.0, 0.0});
    scanner.pty = PtyConfig{};
    scanner.power_up = PowerUp::scip1;
    scanner.timing = Timing::ideal;
    scanner.backend = "embree";
    config.robots = {{.name = "robot", .sensors = {scanner}}};
    expect_same(config);
}

}  // namespace
}  // namespace scipd::daemon
