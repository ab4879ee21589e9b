// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/option_groups.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "daemon/config/mount.h"
#include "daemon/config/sensor.h"
#include "daemon/config/values.h"
#include "daemon/models/registry.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// Adds options of one group; the text of each goes through one of config_values' parsers.
class Group {
  public:
    Group(CLI::App& app, std::string title) : app_(app), title_(std::move(title)) {}

    CLI::Option* add(const std::string& name, const std::string& value, const std::string& help,
                     std::function<void(const std::string&)> take) {
        const auto callback = [name, take = std::move(take)](const CLI::results_t& said) {
            try {
                take(said.front());
            } catch (const std::invalid_argument& refusal) {
                throw CLI::ValidationError(name, refusal.what());
            }
            return true;
        };
        return app_.add_option(name, callback, help)->type_name(value)->group(title_);
    }

    CLI::Option* add_flag(const std::string& name, bool& flag, const std::string& help) {
        return app_.add_flag(name, flag, help)->group(title_);
    }

  private:
    CLI::App& app_;
    std::string title_;
};

void add_world(CLI::App& app, OptionValues& said) {
    Group group{app, "World"};
    Config& config = said.options.config;
    group.add("--scene", "FILE",
              "the world: SDF, URDF, xacro, a ROS map, Stage, MVSim, a mesh or the folder of a "
              "model; default: the rescue maze",
              [&](const auto& text) { config.scene = parse_scene(text, fs::current_path()); });
    group.add(
        "--clock", "CLOCK",
        "wall; or poses: the stamps of the poses are the time, which stands still between them; "
        "default: wall",
        [&](const auto& text) { config.clock = parse_clock(text); });
    group.add("--seed", "N", "the same seed gives the same noise; default: 1",
              [&](const auto& text) { config.seed = parse_seed(text); });
}

void add_robot(CLI::App& app, OptionValues& said) {
    Group group{app, "Robot"};
    group.add("--name", "ROBOT/SENSOR", "what they are called; default: robot/scanner",
              [&](const std::string& text) {
                  const auto slash = text.find('/');
                  if (slash == text.npos) throw std::invalid_argument("must be ROBOT/SENSOR");
                  said.robot.name = parse_name(text.substr(0, slash));
                  said.sensor.name = parse_name(text.substr(slash + 1));
              });
    group.add(
        "--pose", "X,Y,YAW",
        "where the robot starts, or X,Y,Z,ROLL,PITCH,YAW; default: 1,1,0 in the maze, else 0,0,0",
        [&](const auto& text) {
            said.robot.world_from_robot = parse_pose(text);
            said.start_given = true;
        });
    group.add(
        "--poses", "SOURCE",
        "live poses: udp:ADDR:PORT, - for stdin, or a file that is played in real time: TUM, "
        "EuRoC, KITTI or CSV with a header",
        [&](const auto& text) { said.robot.poses = parse_pose_source(text, fs::current_path()); });
}

void add_scanner(CLI::App& app, OptionValues& said) {
    Group group{app, "Scanner"};
    SensorConfig& sensor = said.sensor;
    group.add("--model", "MODEL",
              "one of --list-models; default: UST-10LX, or the one that fits --sensor-from best",
              [&](const auto& text) {
                  sensor.model = parse_model(text);
                  said.model_given = true;
              });
    group.add("--mount", "X,Y,Z,R,P,Y",
              "where it sits on the robot, or the NAME of a link, frame or sensor of the world; "
              "default: 0.25 m up in the maze, else at the origin",
              [&](const auto& text) {
                  take_mount(text, sensor);
                  said.mount_given = true;
              });
    group
        .add("--sensor-from", "MODEL::LINK::SENSOR",
             "mount it where the world has this lidar; the end of its name will do",
             [&](const auto& text) {
                 said.mount_given = true;
                 sensor.mount = NamedMount{.kind = MountKind::lidar, .name = text};
             })
        ->excludes("--mount");
    group.add("--tcp", "ADDR:PORT",
              "where it listens, or none; port 0 takes a free one; default: 127.0.0.1:10940",
              [&](const auto& text) { sensor.tcp = parse_listener(text); });
    group.add("--pty", "LINK", "the name of its tty, auto or none; default: auto",
              [&](const auto& text) { sensor.pty = parse_pty(text, fs::current_path()); });
    group.add("--backend", "NAME", "auto or one of --list-backends; default: auto",
              [&](const auto& text) { sensor.backend = parse_backend(text); });
    group.add("--accuracy", "ideal|sensor",
              "without noise, or with that of the data sheet; default: sensor",
              [&](const auto& text) { sensor.accuracy = parse_accuracy(text); });
    group.add("--timing", "real|ideal",
              "the pace of the real scanner, or answers at once; default: real",
              [&](const auto& text) { sensor.timing = parse_timing(text); });
    group.add(
        "--power-up", "scip2.0|scip1.1|boot",
        "booted; booted and in SCIP 1.1 (URG-04LX only); or just switched on; default: scip2.0",
        [&](const auto& text) { sensor.power_up = parse_power_up(text); });
}

void add_daemon(CLI::App& app, OptionValues& said) {
    Group group{app, "Daemon"};
    Config& config = said.options.config;
    group.add("--control", "SOCKET",
              "the socket of the control API; default: control.sock in the run directory",
              [&](const auto& text) { config.control = parse_socket(text, fs::current_path()); });
    group.add("--http", "ADDR:PORT",
              "where the control API listens on TCP too, or none; default: none",
              [&](const auto& text) { config.http = parse_listener(text); });
}

constexpr const char* alone_title = "Instead of the above";
constexpr const char* general_title = "General";

void add_alone(CLI::App& app, OptionValues& said) {
    Group group{app, alone_title};
    group.add("--config", "FILE.yaml", "run what the file says",
              [&](const auto& text) { said.config = text; });
    group.add("--check", "FILE.yaml", "tell every fault of the file and of its world, and end",
              [&](const auto& text) { said.check = text; });
    group.add_flag("--list-models", said.list_models,
                   "list the scanners that scipd can be, and how sure each figure is");
    group.add_flag("--list-backends", said.list_backends,
                   "list the ways in which this build computes ranges");
    group.add_flag(
        "--probe", said.probe,
        "tell what this machine offers to a depth buffer, and end with 1 if it cannot draw");
}

/// Those that go with all others.
void add_general(CLI::App& app, OptionValues& said) {
    app.add_option("--log-level", said.options.log_level, "how much scipd tells on standard error")
        ->check(CLI::IsMember(
            {"trace", "debug", "info", "warning", "warn", "error", "critical", "off"}))
        ->capture_default_str()
        ->group(general_title);
    app.add_flag(
           "--strict", said.options.strict,
           "refuse a world of which scipd would leave out or change anything, instead of warning")
        ->group(general_title);
    app.set_version_flag("--version", "scipd " SCIPD_VERSION, "tell the version")
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
    add_general(app, said);
}

/// Not CLI11's excludes(): it would list every pair in the help.
void check_alone(const CLI::App& app) {
    for (const CLI::Option* alone : app.get_options()) {
        if (alone->get_group() != alone_title || alone->count() == 0) continue;
        for (const CLI::Option* other : app.get_options()) {
            if (other == alone || other->get_group() == general_title || other->count() == 0) {
                continue;
            }
            throw std::invalid_argument(alone->get_name() + " stands alone: leave " +
                                        other->get_name() + " out");
        }
    }
}

}  // namespace scipd::daemon
