// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a configuration means, and the literal words of every fault in a broken one.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "daemon/config/poses.h"
#include "daemon/config/world_options.h"
#include "daemon/models/model_registry.h"
#include "sim/world/pose.h"
#include "tests/daemon/config/config_fixture.h"
#include "tests/support/backend_names.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using ConfigTest = ConfigFixture;

constexpr const char* whole = R"(scene: room.sdf
seed: 42
clock: wall
robots:
  rescue:
    pose: {xyz: [1, -1.5, 0], rpy: [0, 0, 3.14159]}
    poses: udp:127.0.0.1:14550
    sensors:
      front:
        model: UST-10LX
        mount: {xyz: [0.2, 0, 0.25]}
        tcp: 127.0.0.1:10940
        pty: link/front
      rear:
        model: URG-04LX@3.1.04
        pty: auto
        backend: reference
        accuracy: ideal
        motion: 12
        timing: ideal
  other:
    poses: walk.tum
    sensors:
      only: {model: UTM-30LX, tcp: "[::1]:0", motion: beam}
control: control.sock
http: localhost:8080
)";

TEST_F(ConfigTest, HoldsWhatTheFileSays) {
    const Config config = parse(whole);
    EXPECT_EQ(config.scene, dir_.path() / "room.sdf");
    EXPECT_EQ(config.seed, 42u);
    EXPECT_EQ(config.control, dir_.path() / "control.sock");
    EXPECT_EQ(config.http, (Address{"127.0.0.1", 8080}));
    ASSERT_EQ(config.robots.size(), 2u);

    const RobotConfig& rescue = config.robots[0];
    EXPECT_EQ(rescue.name, "rescue");
    EXPECT_EQ(rescue.world_from_robot, sim::pose_from_rpy({1.0, -1.5, 0.0}, {0.0, 0.0, 3.14159}));
    EXPECT_EQ(rescue.poses->kind, PoseSource::Kind::udp);
    EXPECT_EQ(rescue.poses->address, (Address{"127.0.0.1", 14550}));
    ASSERT_EQ(rescue.sensors.size(), 2u);

    const SensorConfig& front = rescue.sensors[0];
    EXPECT_EQ(front.name, "front");
    EXPECT_EQ(front.model, find_model("UST-10LX"));
    EXPECT_EQ(front.robot_from_sensor.translation_m, glm::dvec3(0.2, 0.0, 0.25));
    EXPECT_EQ(front.tcp, (Address{"127.0.0.1", 10940}));
    EXPECT_EQ(front.pty->link, dir_.path() / "link/front");
    EXPECT_EQ(front.backend, "auto");
    EXPECT_EQ(front.accuracy, sim::Accuracy::sensor);
    EXPECT_EQ(front.motion, std::nullopt);
    EXPECT_EQ(front.timing, Timing::real);

    const SensorConfig& rear = rescue.sensors[1];
    EXPECT_EQ(rear.tcp, std::nullopt);
    EXPECT_EQ(rear.pty, PtyConfig{});
    EXPECT_EQ(rear.backend, "reference");
    EXPECT_EQ(rear.accuracy, sim::Accuracy::ideal);
    EXPECT_EQ(rear.motion, 12);
    EXPECT_EQ(rear.timing, Timing::ideal);

    const RobotConfig& other = config.robots[1];
    EXPECT_EQ(other.world_from_robot, sim::Pose{});
    EXPECT_EQ(other.poses->kind, PoseSource::Kind::file);
    EXPECT_EQ(other.poses->file, dir_.path() / "walk.tum");
    EXPECT_EQ(other.sensors[0].tcp, (Address{"::1", 0}));
}

constexpr const char* every_fault = R"(scene: nowhere.sdf
seed: -1
materials: wood.yaml
sceen: room.sdf
robots:
  rescue:
    pose: {xyz: [1, 2], rpy: [0, north, .inf], yaw: 1}
    body: tank
    poses: {from: udp:somewhere, after: rest, wait_ms: 2000}
    sensors:
      front:
        modle: UST-10LX
        tcp: 127.0.0.1:70000
        tcp: 127.0.0.1:10940
        backend: opengl
        accuracy: fine
        echo: loud
        motion: 0
        link: {baud: 19200}
      rear/left:
        model: UST-99
        timing: fast
  empty: {sensors: {}}
clock: pose
http: 8080
)";

TEST_F(ConfigTest, TellsEveryFaultAtOnceInTheOrderOfLines) {
    EXPECT_THAT(
        faults(every_fault),
        ElementsAre("rig.yaml:1: scene: there is no file 'nowhere.sdf'",
                    "rig.yaml:2: seed: must be a whole number from 0 to 18446744073709551615, "
                    "not '-1'",
                    "rig.yaml:3: materials: there is no file 'wood.yaml'",
                    "rig.yaml:4: sceen: unknown key; did you mean scene?",
                    "rig.yaml:7: robots.rescue.pose.yaw: unknown key; known here are xyz, rpy",
                    "rig.yaml:7: robots.rescue.pose.xyz: must be a list of three numbers, such "
                    "as [1, 2, 0]",
                    "rig.yaml:7: robots.rescue.pose.rpy: must be a number, not 'north'",
                    "rig.yaml:9: robots.rescue.poses.from: must be udp:ADDRESS:PORT such "
                    "as udp:127.0.0.1:14550, not 'udp:somewhere'",
                    "rig.yaml:9: robots.rescue.poses.after: must be hold, extrapolate or none, "
                    "not 'rest'",
                    "rig.yaml:9: robots.rescue.poses.wait_ms: must be 0 to 900 ms, not '2000'",
                    "rig.yaml:11: robots.rescue.sensors.front: needs a model, a camera "
                    "or a ranger; `scipd --list-models` lists them",
                    "rig.yaml:12: robots.rescue.sensors.front.modle: unknown key; did you mean "
                    "model?",
                    "rig.yaml:13: robots.rescue.sensors.front.tcp: must be ADDRESS:PORT such as "
                    "127.0.0.1:10940, [::1]:10940 or localhost:0, not '127.0.0.1:70000'",
                    "rig.yaml:14: robots.rescue.sensors.front.tcp: given twice, first in line "
                    "13; keep one",
                    "rig.yaml:15: robots.rescue.sensors.front.backend: this build has no "
                    "backend 'opengl'; use auto, " +
                        tests::listed_backends(),
                    "rig.yaml:16: robots.rescue.sensors.front.accuracy: must be ideal, "
                    "sensor or material, not 'fine'",
                    "rig.yaml:17: robots.rescue.sensors.front.echo: must be first, strongest "
                    "or last, not 'loud'",
                    "rig.yaml:18: robots.rescue.sensors.front.motion: must be beam or a number "
                    "of poses per sweep, 1 to 100000, not '0'",
                    "rig.yaml:19: robots.rescue.sensors.front.link.baud: is of a tty; give "
                    "pty, or leave it out",
                    "rig.yaml:20: robots.rescue.sensors.rear/left: 'rear/left' is no name: use "
                    "up to 64 letters, digits, _ - and ., not beginning with a dot",
                    "rig.yaml:20: robots.rescue.sensors.rear/left: no driver could reach it: give "
                    "tcp or pty, such as `pty: auto`",
                    "rig.yaml:21: robots.rescue.sensors.rear/left.model: there is no model "
                    "\"UST-99\"; the models are URG-04LX, URG-04LX-UG01, UBG-04LX-F01, "
                    "UHG-08LX, UTM-30LX, UTM-30LX-EW, UXM-30LX-E, UXM-30LX-EW, UXM-30LXH-EWA, "
                    "UST-05LX, UST-10LX, UST-10LX-H01, UST-10LX-H02, UST-20LX, UST-20LX-H01, "
                    "UST-30LX, UST-30LC; `scipd --list-models` shows their firmware",
                    "rig.yaml:22: robots.rescue.sensors.rear/left.timing: must be real or "
                    "ideal, not 'fast'",
                    "rig.yaml:23: robots.empty: needs at least one sensor, under sensors",
                    "rig.yaml:24: clock: must be wall or poses, not 'pose'",
                    "rig.yaml:25: http: must be ADDRESS:PORT such as 127.0.0.1:10940, "
                    "[::1]:10940 or localhost:0, not '8080'"));
}

TEST_F(ConfigTest, ReadsWhatHoldsWhereThereAreNoPoses) {
    dir_.write("walk.tum", "0 0 0 0 0 0 0 1\n");
    const Config config = parse(R"(clock: poses
robots:
  tank:
    body: hull
    poses: {from: udp:127.0.0.1:1, before: none, after: extrapolate, stale_s: 0.25, jump_mps: 5,
            wait_ms: 30}
    sensors:
      a: {model: UST-10LX, pty: auto}
      b: {model: UST-10LX, pty: auto, sees_body: true}
  tram:
    poses: {from: walk.tum, after: none, speed: 2.5, loop: true, format: kitti, times: walk.tum}
    sensors:
      a: {model: UST-10LX, pty: auto}
)");
    EXPECT_EQ(config.clock, ClockKind::poses);
    const RobotConfig& tank = config.robots[0];
    EXPECT_EQ(tank.body, "hull");
    EXPECT_EQ(tank.poses->kind, PoseSource::Kind::udp);
    EXPECT_EQ(tank.policy, (sim::PosePolicy{.absent_before = true,
                                            .after = sim::PosePolicy::After::extrapolate,
                                            .stale_after = std::chrono::milliseconds(250),
                                            .fastest_mps = 5.0}));
    EXPECT_EQ(pose_policy(config, tank), tank.policy);
    EXPECT_EQ(tank.sensors[0].wait_for_poses, std::chrono::milliseconds(30));
    EXPECT_FALSE(tank.sensors[0].sees_body);
    EXPECT_TRUE(tank.sensors[1].sees_body);
    const RobotConfig& tram = config.robots[1];
    EXPECT_EQ(tram.policy.after, sim::PosePolicy::After::absent);
    EXPECT_EQ(tram.poses->speed, 2.5);
    EXPECT_TRUE(tram.poses->loop);
    EXPECT_EQ(tram.poses->format, sim::TrajectoryFormat::kitti);
    EXPECT_EQ(tram.poses->times, dir_.path() / "walk.tum");
    EXPECT_EQ(tram.sensors[0].wait_for_poses, std::chrono::nanoseconds::zero());
}

TEST_F(ConfigTest, ExtrapolatesLivePosesOnTheWallClockUnlessItSaysOtherwise) {
    using After = sim::PosePolicy::After;
    const auto after = [&](const std::string& clock, const std::string& poses) {
        const Config config = parse("clock: " + clock + "\nrobots:\n  tank:\n    poses: " + poses +
                                    "\n    sensors:\n      a: {model: UST-10LX, pty: auto}\n");
        return pose_policy(config, config.robots[0]).after;
    };
    EXPECT_EQ(after("wall", "udp:127.0.0.1:1"), After::extrapolate);
    EXPECT_EQ(after("wall", "{from: 'ros2:/odom', stale_s: 1}"), After::extrapolate);
    EXPECT_EQ(after("wall", "{from: udp:127.0.0.1:1, after: hold}"), After::hold);
    EXPECT_EQ(after("wall", "{from: udp:127.0.0.1:1, after: none}"), After::absent);
    EXPECT_EQ(after("poses", "udp:127.0.0.1:1"), After::hold);
    EXPECT_EQ(after("wall", "'-'"), After::hold);
    EXPECT_EQ(after("wall", "walk.tum"), After::hold);
}

TEST_F(ConfigTest, ReadsWhatAMapAndAnSdfLeaveOpen) {
    const std::string robots = "robots: {r: {sensors: {s: {model: UST-10LX, pty: auto}}}}\n";
    const Config config = parse(robots +
                                "xacro: {angle: 40, rear: true}\ngeometry: collision\nstrict: "
                                "true\nmap: {z: [-0.5, 3], material: brick, unknown: wall}");
    EXPECT_EQ(config.xacro, (sim::XacroArguments{{"angle", "40"}, {"rear", "true"}}));
    EXPECT_EQ(config.geometry, sim::SdfGeometry::collision);
    EXPECT_TRUE(config.strict);
    EXPECT_EQ(config.map, (sim::MapOptions{-0.5, 3.0, "brick", sim::UnknownCells::wall}));
    EXPECT_THAT(faults(robots + "geometry: both\nmap: {z: [2, 1], unknown: maybe, height: 2}"),
                ElementsAre("rig.yaml:2: geometry: must be visual or collision, not 'both'",
                            "rig.yaml:3: map.height: unknown key; known here are z, material, "
                            "unknown",
                            "rig.yaml:3: map.z: must be the heights of the walls, [BOTTOM, TOP], "
                            "such as [0, 2]",
                            "rig.yaml:3: map.unknown: must be free, wall or unknown, not "
                            "'maybe'"));
}

TEST_F(ConfigTest, ReadsWhatAWorldMayTake) {
    const std::string robots = "robots: {r: {sensors: {s: {pty: auto, model: UST-10LX}}}}\n";
    const auto config =
        parse(robots +
              "limits: {world_memory_mb: 20000, world_triangles: 50000000, world_overlap: 5000, "
              "world_load_s: 900}");
    EXPECT_EQ(config.limits.memory_bytes, 20'000'000'000U);
    EXPECT_EQ(config.limits.triangles, 50'000'000U);
    EXPECT_EQ(config.limits.overlap, 5'000U);
    EXPECT_EQ(config.limits.load_time, std::chrono::seconds(900));
    EXPECT_EQ(parse(robots).limits, WorldLimits{});
    EXPECT_THAT(
        faults(robots + "limits: {world_memory_mb: 0, world_triangles: 8GiB, memory: 2}"),
        ElementsAre("rig.yaml:2: limits.memory: unknown key; known here are "
                    "world_memory_mb, world_triangles, world_overlap, world_load_s, "
                    "scip_line_bytes, scanner_connections, http_connections, control_connections, "
                    "http_header_bytes, http_body_bytes, websocket_messages_per_s, "
                    "websocket_queue_bytes, added_models, added_triangles, poses_per_s",
                    "rig.yaml:2: limits.world_memory_mb: must be a whole number from 1 "
                    "to 1000000, not '0'",
                    "rig.yaml:2: limits.world_triangles: must be a whole number from 1 "
                    "to 1000000000, not '8GiB'"));
}

TEST_F(ConfigTest, ReadsWhatClientsMay) {
    const std::string robots = "robots: {r: {sensors: {s: {pty: auto, model: UST-10LX}}}}\n";
    EXPECT_EQ(parse(robots).client_limits, LimitValues{});
    const auto config = parse(robots + "limits: {http_body_bytes: 5, poses_per_s: 7}");
    EXPECT_EQ(config.client_limits[Limit::http_body_bytes], 5);
    EXPECT_EQ(config.client_limits[Limit::poses_per_s], 7);
    EXPECT_EQ(config.client_limits[Limit::scip_line_bytes], 128);
    EXPECT_THAT(faults(robots + "limits:\n  scip_line_bytes: 31\n  http_connections: 0\n"
                                "  added_models: -1"),
                ElementsAre("rig.yaml:3: limits.scip_line_bytes: must be a whole number from 32 "
                            "to 4096, not '31'",
                            "rig.yaml:4: limits.http_connections: must be a whole number from 1 "
                            "to 10000, not '0'",
                            "rig.yaml:5: limits.added_models: must be a whole number from 1 to "
                            "1000000, not '-1'"));
}

TEST_F(ConfigTest, LimitsWithAWorldWhatItsMeshesMayTake) {
    const sim::SceneOptions usual{};
    sim::SceneOptions options;
    apply(WorldLimits{}, options);
    EXPECT_EQ(options.sdf.most_memory_bytes, usual.sdf.most_memory_bytes);
    EXPECT_EQ(options.sdf.most_triangles, usual.sdf.most_triangles);
    EXPECT_EQ(options.sdf.mesh.triangles, usual.sdf.mesh.triangles);
    EXPECT_EQ(options.sdf.mesh.memory_bytes, usual.sdf.mesh.memory_bytes);
    EXPECT_EQ(options.limits.memory_bytes, usual.limits.memory_bytes);
    apply({.memory_bytes = 1'000'000'000, .triangles = 50'000'000}, options);
    EXPECT_EQ(options.sdf.mesh.triangles, 50'000'000U);
    EXPECT_EQ(options.sdf.mesh.memory_bytes, 1'000'000'000U);
    EXPECT_GT(options.limits.memory_bytes, options.sdf.mesh.memory_bytes);
    apply({.triangles = 1000, .load_time = std::chrono::seconds(3)}, options);
    EXPECT_EQ(options.sdf.mesh.triangles, 1000U);
    EXPECT_EQ(options.limits.wall_time, std::chrono::seconds(3));
}

TEST_F(ConfigTest, SaysWhatPosesCannotBe) {
    const auto faults_of = [&](const std::string& poses) {
        return faults("robots: {r: {poses: {" + poses +
                      "}, sensors: {s: {model: UST-10LX, pty: auto}}}}");
    };
    EXPECT_THAT(faults_of("after: hold"),
                ElementsAre("rig.yaml:1: robots.r.poses: needs from: udp:ADDR:PORT, a trajectory "
                            "or -"));
    EXPECT_THAT(faults_of("from: '-', speed: 2, loop: true"),
                ElementsAre("rig.yaml:1: robots.r.poses.speed: is of a trajectory; live poses "
                            "come when they come",
                            "rig.yaml:1: robots.r.poses.loop: is of a trajectory; live poses "
                            "come when they come"));
    EXPECT_THAT(faults_of("from: '-', format: tum"),
                ElementsAre("rig.yaml:1: robots.r.poses.format: is of a trajectory; live poses "
                            "come when they come"));
    EXPECT_THAT(faults_of("from: walk.tum, format: gpx"),
                ElementsAre("rig.yaml:1: robots.r.poses.format: must be tum, euroc, kitti or "
                            "csv, not 'gpx'; leave it out to go by the content"));
    EXPECT_THAT(faults_of("from: '-', before: now, stale_s: 0, jump_mps: -1"),
                ElementsAre("rig.yaml:1: robots.r.poses.before: must be hold or none, not 'now'",
                            "rig.yaml:1: robots.r.poses.stale_s: must be more than 0 and up to "
                            "3600 s, not '0'",
                            "rig.yaml:1: robots.r.poses.jump_mps: must be more than 0 and up to "
                            "1e6 m/s, not '-1'"));
}

TEST_F(ConfigTest, RefusesWhatTwoCannotShare) {
    EXPECT_THAT(
        faults(R"(scene: room.sdf
http: 127.0.0.1:1002
robots:
  a:
    poses: "-"
    sensors:
      one: {model: UST-10LX, tcp: 127.0.0.1:1001, pty: link}
      two: {model: UST-10LX, tcp: 127.0.0.1:0, pty: auto}
  b:
    poses: "-"
    sensors:
      one: {model: UST-10LX, tcp: localhost:1001, pty: auto}
      two: {model: UST-10LX, tcp: 127.0.0.1:0, pty: x/../link}
      three: {model: UST-10LX, tcp: 127.0.0.1:1002}
)"),
        ElementsAre(
            "rig.yaml:10: robots.b.poses: standard input is taken by robots.a.poses; use another",
            "rig.yaml:12: robots.b.sensors.one.tcp: 127.0.0.1:1001 is taken by "
            "robots.a.sensors.one.tcp; use another",
            "rig.yaml:13: robots.b.sensors.two.pty: link is taken by robots.a.sensors.one.pty; "
            "use another",
            "rig.yaml:14: robots.b.sensors.three.tcp: 127.0.0.1:1002 is taken by http; use "
            "another"));
}

TEST_F(ConfigTest, NeedsARobotWithASensor) {
    const std::string start = "scene: room.sdf\n";
    EXPECT_THAT(faults(start), ElementsAre("rig.yaml:1: needs at least one robot, under robots"));
    EXPECT_THAT(faults(start + "robots: {}"),
                ElementsAre("rig.yaml:2: robots: needs at least one robot, under robots"));
    EXPECT_THAT(faults(start + "robots:"),
                ElementsAre("rig.yaml:2: robots: must be a map of keys and values, such as robots: "
                            "{cart: {sensors: {front: {model: UST-10LX}}}}"));
    EXPECT_THAT(faults(start + "robots: {r: {}}"),
                ElementsAre("rig.yaml:2: robots.r: needs at least one sensor, under sensors"));
    EXPECT_THAT(
        faults(start + "robots: {r: {sensors: [a]}}"),
        ElementsAre("rig.yaml:2: robots.r.sensors: must be a map of keys and values, such as "
                    "sensors: {front: {model: UST-10LX}}"));
}

TEST_F(ConfigTest, SaysWhatAValueMayBe) {
    EXPECT_THAT(sensor_faults("backend:"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.backend: has no value; give one or "
                            "leave the key out"));
    EXPECT_THAT(sensor_faults("backend: [auto]"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.backend: must be a single value, "
                            "not a list"));
    EXPECT_THAT(sensor_faults("mount: [1, 2, 3]"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.mount: must be a map of keys and "
                            "values, such as mount: {xyz: [0, 0, 0.3], rpy: [0, 0, 0]}"));
    EXPECT_THAT(sensor_faults("mount: {xyz: [1e8, 0, 0]}"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.mount.xyz: must lie within 1e7 m, "
                            "not '1e8'"));
    EXPECT_THAT(sensor_faults("mount: {rpy: [nan, 0, 0]}"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.mount.rpy: must be a number, not "
                            "'nan'"));
    EXPECT_THAT(sensor_faults("accuracy: best"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.accuracy: must be ideal, sensor or "
                            "material, not 'best'"));
    EXPECT_THAT(sensor_faults("{a: b}: c"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s: a key must be a plain name"));
    EXPECT_THAT(sensor_faults("tcp: none"), ElementsAre());
    EXPECT_THAT(faults("scene: room.sdf\n"
                       "robots: {r: {sensors: {s: {model: UST-10LX, tcp: none, pty: none}}}}"),
                ElementsAre("rig.yaml:2: robots.r.sensors.s: no driver could reach it: give tcp or "
                            "pty, such as `pty: auto`"));
}

TEST_F(ConfigTest, NamesMaterialsBesideItself) {
    const std::string robots = "robots: {r: {sensors: {s: {model: UST-10LX, pty: auto}}}}\n";
    const auto file = dir_.write("wood.yaml", "materials: {}\n");
    const Config config = parse(robots + "materials: wood.yaml\n");
    EXPECT_EQ(config.materials, file);
    EXPECT_THAT(config.place_of("materials"), testing::EndsWith("rig.yaml:2: materials: "));
    EXPECT_TRUE(parse(robots).materials.empty());
    EXPECT_THAT(faults(robots + "materials: ."), ElementsAre(testing::HasSubstr("name a file")));
}

TEST_F(ConfigTest, SaysWhereTheTextIsNotYaml) {
    EXPECT_THAT(faults("scene: room.sdf\nrobots: {r: [}\n"),
                ElementsAre(HasSubstr("rig.yaml:2: not YAML: ")));
    const std::string tabs = ": YAML does not allow tabs for indentation; use spaces";
    EXPECT_THAT(faults("scene: room.sdf\n\tseed: 1\n"), ElementsAre("rig.yaml:2" + tabs));
    EXPECT_THAT(faults("robots:\n  r:\n\tsensors: 3\n"), ElementsAre("rig.yaml:3" + tabs));
    EXPECT_THAT(faults("robots:\n  r:\n\t  sensors: 3\n"), ElementsAre("rig.yaml:3" + tabs));
    EXPECT_THAT(faults("just words"),
                ElementsAre(testing::StartsWith(
                    "rig.yaml:1: must be a map of keys and values; known here are scene, ")));
    EXPECT_THAT(faults(std::string{whole} + "---\nscene: room.sdf\n"),
                ElementsAre("rig.yaml:27: a second YAML document; keep one"));
    // On which the library's own way to read all documents never ends.
    EXPECT_THAT(faults("!tag,"), testing::Contains("rig.yaml:1: a second YAML document; keep one"));
}

TEST_F(ConfigTest, AFaultIsALineThatCanBeShown) {
    EXPECT_THAT(sensor_faults("\"a\\n\\x1b\": 1"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.a??: unknown key; known here are "
                            "model, camera, ranger, mount, tcp, pty, backend, depth, accuracy, "
                            "echo, interference, motion, timing, power_up, clock, link, profile, "
                            "sees_body, noise, bias, replay"));
    const auto told = faults(
        "scene: room.sdf\nrobots: {r: {sensors: {s: "
        "{pty: auto, model: \"UST\\n10\"}}}}");
    EXPECT_THAT(told, ElementsAre(HasSubstr("there is no model \"UST?10\"")));
    // The library quotes the byte that it stumbles over.
    EXPECT_THAT(faults("\"\\\x01\""),
                ElementsAre("rig.yaml:1: not YAML: unknown escape character: ?"));
}

TEST_F(ConfigTest, BoundsWhatAHostileFileCosts) {
    EXPECT_THAT(faults(std::string(500'000, '[')),
                ElementsAre("rig.yaml:1: nested too deeply to be a configuration"));
    EXPECT_THAT(faults(std::string((1 << 20) + 1, ' ')),
                ElementsAre("rig.yaml:1: larger than 1 MiB; split it"));

    std::string many = "scene: room.sdf\nrobots:\n";
    for (int i = 0; i < 5000; ++i)
        many += "  r" + std::to_string(i) + ": {}\n";
    EXPECT_THAT(faults(many), ElementsAre("rig.yaml:2: robots: has more than 4096 entries; "
                                          "split it"));

    // One alias a robot, and every robot would have a hundred sensors.
    std::string aliases = "scene: room.sdf\nrobots:\n  r: &r\n    sensors:\n";
    for (int i = 0; i < 100; ++i)
        aliases += "      s" + std::to_string(i) + ": {model: UST-10LX, pty: auto}\n";
    for (int i = 0; i < 4000; ++i)
        aliases += "  r" + std::to_string(i) + ": *r\n";
    const auto told = faults(aliases);
    ASSERT_EQ(told.size(), 101u);
    EXPECT_EQ(told.front(),
              "rig.yaml:144: robots.r39: more than 4096 sensors in all; split them "
              "over several daemons");
    EXPECT_THAT(told.back(), HasSubstr("too many faults"));
}

TEST_F(ConfigTest, AnAliasIsWhatItStandsFor) {
    const Config config = parse(R"(scene: room.sdf
robots:
  r:
    sensors:
      a: {model: UST-10LX, tcp: 127.0.0.1:0, mount: &front {xyz: [0.2, 0, 0]}}
      b: {model: UST-20LX, tcp: 127.0.0.1:0, mount: *front}
)");
    EXPECT_EQ(config.robots[0].sensors[1].robot_from_sensor.translation_m,
              glm::dvec3(0.2, 0.0, 0.0));
}

TEST_F(ConfigTest, LoadsAFileRelativeToItself) {
    const auto file = dir_.write("rig.yaml", whole);
    EXPECT_EQ(load_config(file), parse(whole));
    EXPECT_EQ(load_config(file).scene, dir_.path() / "room.sdf");
}

TEST_F(ConfigTest, NamesAFileThatCannotBeRead) {
    const auto missing = (dir_.path() / "missing.yaml").string();
    try {
        load_config(missing);
        FAIL();
    } catch (const sim::LoadError& error) {
        EXPECT_EQ(error.what(), missing + ": no such file; name a configuration of at most 1 MiB");
    }
    EXPECT_THROW(load_config(dir_.path()), sim::LoadError);
}

}  // namespace
}  // namespace scipd::daemon
