// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/option_groups.h"

#include <functional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "daemon/command_line/completions.h"
#include "daemon/command_line/version.h"
#include "daemon/config/doors.h"
#include "daemon/config/mount.h"
#include "daemon/config/numbers.h"
#include "daemon/config/pose_source.h"
#include "daemon/config/read_replay.h"
#include "daemon/config/sensor.h"
#include "daemon/config/values.h"
#include "daemon/models/model_registry.h"
#include "daemon/program/option_group.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

void warn_of_degrees(const char* option, const std::string& text, OptionValues& said) {
    if (const auto warning = degrees_in_pose(text))
        said.options.config.warnings.push_back(std::string(option) + ": " + *warning);
}

void add_world(CLI::App& app, OptionValues& said) {
    Group group{app, "World"};
    Overrides& over = said.options.overrides;
    group.add(
        "--scene", "FILE",
        "the world: SDF, URDF, xacro, a ROS map, Stage, MVSim, a mesh or the folder of a "
        "model; default: the rescue maze",
        [&](const auto& text) { return put(parse_scene(text, fs::current_path()), over.scene); });
    group
        .add("--xacro", "NAME:=VALUE",
             "an argument of a world in xacro; give the option once for each; default: what the "
             "file or the configuration says",
             [&](const auto& text) {
                 return parse_xacro_argument(text).map([&](const auto& argument) {
                     over.xacro.insert_or_assign(argument.first, argument.second);
                 });
             })
        ->take_all();
    group.add("--geometry", "visual|collision",
              "by which geometry of SDF and URDF scanners see the world; default: visual",
              [&](const auto& text) { return put(parse_geometry(text), over.geometry); });
    group.add("--materials", "FILE",
              "materials that are added to those of scipd, or replace them; default: none",
              [&](const auto& text) {
                  return put(parse_file(text, fs::current_path()), over.materials);
              });
    group.add(
        "--clock", "CLOCK",
        "wall; or poses: the stamps of the poses are the time, which stands still between them; "
        "default: wall",
        [&](const auto& text) { return put(parse_clock(text), over.clock); });
    group.add("--seed", "N", "the same seed gives the same noise; default: 1",
              [&](const auto& text) { return put(parse_seed(text), over.seed); });
}

void add_robot(CLI::App& app, OptionValues& said) {
    Group group{app, robot_title};
    group.add("--name", "ROBOT/SENSOR", "what they are called; default: robot/scanner",
              [&](const std::string& text) {
                  const auto slash = text.find('/');
                  if (slash == text.npos)
                      return sim::Expected<>{sim::refuse(
                          "must be ROBOT/SENSOR, such as rescue/front, not '" + text + "'")};
                  return put(parse_name(text.substr(0, slash)), said.robot.name).and_then([&] {
                      return put(parse_name(text.substr(slash + 1)), said.sensor.name);
                  });
              });
    group.add(
        "--pose", "X,Y,YAW",
        "where the robot starts, or X,Y,Z,ROLL,PITCH,YAW; default: 1,1,0 in the maze, else 0,0,0",
        [&](const auto& text) {
            said.start_given = true;
            warn_of_degrees("--pose", text, said);
            return put(parse_pose(text), said.robot.world_from_robot);
        });
    group.add(
        "--poses", "SOURCE",
        "live poses: udp:ADDR:PORT, - for stdin, gz:[/TOPIC], ros2:/TOPIC, "
        "rosbridge:ws://HOST:PORT/TOPIC, vda5050:MANUFACTURER/SERIAL for a vehicle at the broker, "
        "or a file that is played in real time: TUM, EuRoC, KITTI or CSV with a header",
        [&](const auto& text) {
            return put(parse_pose_source(text, fs::current_path()), said.robot.poses);
        });
}

void add_replay(Group& group, SensorConfig& sensor) {
    group.add("--replay", "FILE",
              "play this recording in place of a world: MCAP, UBH, CSV, JSON lines, bags of ROS, "
              "rows of numbers, logs of CARMEN, CoreSLAM and Player, .npy or pcap; default: none",
              [&](const auto& text) {
                  if (!sensor.replay) sensor.replay.emplace();
                  return put(parse_file(text, fs::current_path()), sensor.replay->file);
              });
    group
        .add(
            "--loop", "true|on|false",
            "play it again at its end: each round has the recorded stamps (true), or the stamps go "
            "on (on); default: false",
            [&](const auto& text) {
                if (!sensor.replay) sensor.replay.emplace();
                return put(parse_loop(text), sensor.replay->loop);
            })
        ->expected(0, 1)
        ->default_str("true")
        ->needs("--replay");
}

void add_scanner(CLI::App& app, OptionValues& said) {
    Group group{app, scanner_title};
    SensorConfig& sensor = said.sensor;
    group.add("--model", "MODEL",
              "one of --list-models; default: UST-10LX, or the one that fits --sensor-from best",
              [&](const auto& text) {
                  said.model_given = true;
                  return put(parse_model(text), sensor.model);
              });
    add_replay(group, sensor);
    group.add("--mount", "X,Y,Z,R,P,Y",
              "where it sits on the robot, or the NAME of a link, frame or sensor of the world; "
              "default: 0.25 m up in the maze, else at the origin",
              [&](const auto& text) {
                  said.mount_given = true;
                  warn_of_degrees("--mount", text, said);
                  return take_mount(text, sensor);
              });
    group
        .add("--sensor-from", "MODEL::LINK::SENSOR",
             "mount it where the world has this lidar; the end of its name will do",
             [&](const auto& text) {
                 said.mount_given = true;
                 sensor.mount = NamedMount{.kind = MountKind::lidar, .name = text};
                 return sim::Expected<>{};
             })
        ->excludes("--mount");
    group.add("--tcp", "ADDR:PORT",
              "where it listens, or none; port 0 takes a free one; default: 127.0.0.1:10940",
              [&](const auto& text) { return put(parse_listener(text), sensor.tcp); });
    group.add(
        "--pty", "LINK", "the name of its tty, auto or none; default: auto",
        [&](const auto& text) { return put(parse_pty(text, fs::current_path()), sensor.pty); });
    group.add("--backend", "NAME", "auto or one of --list-backends; default: auto",
              [&](const auto& text) { return put(parse_backend(text), sensor.backend); });
    group.add("--accuracy", "ideal|sensor|material",
              "what geometry says, the scanner's errors, or also those of what it sees; default: "
              "sensor",
              [&](const auto& text) { return put(parse_accuracy(text), sensor.accuracy); });
    group.add("--timing", "real|ideal",
              "the pace of the real scanner, or answers at once; default: real",
              [&](const auto& text) { return put(parse_timing(text), sensor.timing); });
    group.add(
        "--power-up", "scip2.0|scip1.1|boot",
        "booted; booted and in SCIP 1.1 (URG-04LX only); or just switched on; default: scip2.0",
        [&](const auto& text) { return put(parse_power_up(text), sensor.power_up); });
}

void add_daemon(CLI::App& app, OptionValues& said) {
    Group group{app, "Daemon"};
    Overrides& over = said.options.overrides;
    group.add("--control", "SOCKET",
              "the socket of the control API; default: control.sock in the run directory",
              [&](const auto& text) {
                  return put(parse_socket(text, fs::current_path()), over.control);
              });
    group.add("--broker", "URL",
              "share the world with other daemons by this MQTT broker, mqtt://HOST:PORT; default: "
              "the world is this daemon's alone",
              [&](const auto& text) { return put(parse_broker(text), over.broker); });
    group.add("--world", "NAME", "which of the broker's worlds; goes with --broker",
              [&](const auto& text) { return put(parse_world_name(text), over.world); });
}

void add_alone(CLI::App& app, OptionValues& said) {
    Group group{app, alone_title};
    group.add(
        "--config", "FILE.yaml",
        "run what the file says; options of the world, the daemon and below go with it, and hold "
        "in place of what it says",
        [&](const auto& text) { return put<fs::path>(text, said.config); });
    group.add("--check", "FILE",
              "tell what a configuration, a world, a map, a mesh, a scenario, materials or a "
              "trajectory holds and every fault in it, and end",
              [&](const auto& text) { return put<fs::path>(text, said.check); });
    group.add_flag("--list-models", said.list_models,
                   "list the scanners that scipd can be, and how sure each figure is");
    group.add_flag("--list-backends", said.list_backends,
                   "list the ways in which this build computes ranges");
    group.add_flag(
        "--probe", said.probe,
        "tell what this machine offers to a depth buffer, and end with 1 if it cannot draw");
    app.add_option("--completion", said.completion, "print completions for a shell")
        ->type_name("SHELL")
        ->check(CLI::IsMember(completion_shells()))
        ->group(alone_title);
}

/// The world is that of the options or of the configuration.
void add_map(CLI::App& app, OptionValues& said) {
    Group group{app, map_title};
    group.add("--map", "MAP.yaml",
              "write a ROS map of the world, for AMCL, and end; the picture MAP.pgm lies beside it",
              [&](const auto& text) -> sim::Expected<> {
                  if (!text.ends_with(".yaml")) return sim::refuse("must end with .yaml");
                  return put<fs::path>(text, said.map.file);
              });
    group.add("--map-z", "Z",
              "the height of the scanner above z = 0 of the world in m, or LOW:HIGH",
              [&](const auto& text) { return put(sim::parse_heights(text), said.map.heights); });
    group.add(
        "--map-resolution", "M", "the side of a cell in m; default: 0.05",
        [&](const auto& text) { return put(sim::parse_cell_size(text), said.map.resolution_m); });
}

sim::Expected<unsigned> parse_threads(std::string_view text) {
    constexpr int most_threads = 1024;
    return parse_whole(text, 1, most_threads).map([](int threads) {
        return static_cast<unsigned>(threads);
    });
}

/// Adds the options that hold whatever the configuration says.
void add_overrides(CLI::App& app, OptionValues& said) {
    Group group{app, general_title};
    app.add_flag("--free-ports", said.options.overrides.free_ports,
                 "scanners listen on free ports of 127.0.0.1 and have no ttys, whatever the "
                 "configuration says: beside another scipd with it")
        ->group(general_title);
    group.add("--scenario", "FILE",
              "what goes wrong at the scanners, and when; default: what the configuration says",
              [&](const auto& text) {
                  return put(parse_file(text, fs::current_path()), said.options.overrides.scenario);
              });
    group.add("--http", "ADDR:PORT",
              "where the live page and the control API listen on TCP, on loopback, or none; "
              "default: what the configuration says, else none",
              [&](const auto& text) { return put(parse_http(text), said.options.overrides.http); });
}

/// Adds the options that go with all others.
void add_general(CLI::App& app, OptionValues& said) {
    Group group{app, general_title};
    app.add_option("--log-level", said.options.log_level, "how much scipd tells on standard error")
        ->check(CLI::IsMember(
            {"trace", "debug", "info", "warning", "warn", "error", "critical", "off"}))
        ->capture_default_str()
        ->group(general_title);
    app.add_option("--log-format", said.options.log_format,
                   "text for people, or json: a document a line")
        ->type_name("text|json")
        ->check(CLI::IsMember({"text", "json"}))
        ->capture_default_str()
        ->group(general_title);
    app.add_flag(
           "--strict", said.options.overrides.strict,
           "refuse a world or a trajectory of which scipd would leave out or change anything, and "
           "numbers in a wrong unit, instead of warning")
        ->group(general_title);
    group.add("--threads", "N",
              "how many threads scanners live on, or with --clock poses are cast on; default: as "
              "many as there are processors",
              [&said](const auto& text) { return put(parse_threads(text), said.options.threads); });
    app.set_version_flag("--version", version_of("scipd"), "print the version")
        ->group(general_title);
    app.set_help_flag();
    app.set_help_flag("-h,--help", "print this text")->group(general_title);
}

}  // namespace

OptionValues::OptionValues() {
    robot.name = "robot";
    sensor.name = "scanner";
    sensor.model = find_model("UST-10LX");
    sensor.tcp = Address{"127.0.0.1", 10940};
    sensor.pty = PtyConfig{};
}

void add_options(CLI::App& app, OptionValues& said) {
    add_world(app, said);
    add_robot(app, said);
    add_scanner(app, said);
    add_daemon(app, said);
    add_alone(app, said);
    add_map(app, said);
    add_overrides(app, said);
    add_general(app, said);
}

}  // namespace scipd::daemon
