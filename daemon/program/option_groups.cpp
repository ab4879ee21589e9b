// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/option_groups.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "daemon/command_line/completions.h"
#include "daemon/command_line/version.h"
#include "daemon/config/doors.h"
#include "daemon/config/file_kind.h"
#include "daemon/config/mount.h"
#include "daemon/config/numbers.h"
#include "daemon/config/poses.h"
#include "daemon/config/sensor.h"
#include "daemon/config/values.h"
#include "daemon/models/model_registry.h"
#include "sim/expected.h"
#include "sim/loaders/mesh/mesh_file.h"

namespace scipd::daemon {
namespace {

/// Adds options of one group. The text of each goes through a parser of daemon/config.
class Group {
  public:
    Group(CLI::App& app, std::string title) : app_(app), title_(std::move(title)) {}

    CLI::Option* add(const std::string& name, const std::string& value, const std::string& help,
                     std::function<sim::Expected<>(const std::string&)> take) {
        const auto callback = [name, take = std::move(take)](const CLI::results_t& said) {
            for (const std::string& text : said) {
                const auto taken = take(text);
                if (!taken) throw CLI::ValidationError(name, taken.error().why);
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

template <class Value, class Target>
sim::Expected<> put(sim::Expected<Value> value, Target& target) {
    return value.map([&](const Value& good) { target = good; });
}

namespace fs = std::filesystem;
using std::string_view_literals::operator""sv;

constexpr std::array recordings{".mcap"sv,   ".bag"sv, ".db3"sv,  ".ubh"sv,    ".jsonl"sv,
                                ".ndjson"sv, ".npy"sv, ".pcap"sv, ".pcapng"sv, ".log"sv};

/// Options of scipd, and the same as other programs name them.
constexpr std::array<std::pair<const char*, std::string_view>, 8> foreign_options{{
    {"--tcp ADDR:PORT", " --port --host --ip --address "sv},
    {"--pty LINK", " --device --tty --serial-port "sv},
    {"--accuracy ideal|sensor|material, or `scipctl sensor set noise=2` for a factor", " --noise "},
    {"--model MODEL", " --lidar --sensor --scanner "sv},
    {"--scene FILE", " --sdf --urdf --mesh --file "sv},
    {"--replay FILE", " --bag --recording "sv},
    {"--log-level debug", " --verbose --debug "sv},
    {"--http ADDR:PORT", " --web --page "sv},
}};

/// Configuration key equivalent to this option; empty if the option is not per scanner.
std::string key_of(const CLI::Option& option) {
    const std::string robot = "robots.ROBOT";
    const std::string sensor = robot + ".sensors.SENSOR";
    std::string name = option.get_name().substr(2);
    std::ranges::replace(name, '-', '_');
    if (name == "name") return sensor;
    if (name == "sensor_from") return sensor + ".mount.sensor";
    if (name == "loop") return sensor + ".replay.loop";
    if (option.get_group() == robot_title) return robot + '.' + name;
    return option.get_group() == scanner_title ? sensor + '.' + name : "";
}

/// Options that decide how a world is read, so that they go with --check.
constexpr std::array of_reading{"--xacro"sv, "--geometry"sv};

sim::Expected<> check_beside(const CLI::Option& alone, const CLI::Option& other) {
    const std::string key = key_of(other);
    if (alone.get_name() == "--check" &&
        std::ranges::find(of_reading, other.get_name()) != of_reading.end())
        return {};
    if (alone.get_name() != "--config")
        return sim::refuse(alone.get_name() + " cannot be combined with other options: leave " +
                           other.get_name() + " out");
    if (other.get_group() == alone_title)
        return sim::refuse("--config and " + other.get_name() + " do not go together");
    if (key.empty()) return {};
    return sim::refuse(other.get_name() + " is for a scanner without a configuration: beside " +
                       "--config, write " + key + " into the file");
}

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
    group.add("--clock", "CLOCK",
              "wall; or poses: time advances with the stamps of the poses and is paused between "
              "them; default: wall",
              [&](const auto& text) { return put(parse_clock(text), over.clock); });
    group.add("--seed", "N", "the same seed gives the same noise; default: 1",
              [&](const auto& text) { return put(parse_seed(text), over.seed); });
}

void add_robot(CLI::App& app, OptionValues& said) {
    Group group{app, robot_title};
    group.add(
        "--name", "ROBOT/SENSOR", "names of the robot and its scanner; default: robot/scanner",
        [&](const std::string& text) {
            const auto slash = text.find('/');
            if (slash == text.npos)
                return sim::Expected<>{
                    sim::refuse("must be ROBOT/SENSOR, such as rescue/front, not '" + text + "'")};
            return put(parse_name(text.substr(0, slash)), said.robot.name).and_then([&] {
                return put(parse_name(text.substr(slash + 1)), said.sensor.name);
            });
        });
    group.add(
        "--pose", "X,Y,YAW",
        "start pose of the robot, or X,Y,Z,ROLL,PITCH,YAW; default: 1,1,0 in the maze, else 0,0,0",
        [&](const auto& text) {
            said.start_given = true;
            warn_of_degrees("--pose", text, said);
            return put(parse_pose(text), said.robot.world_from_robot);
        });
    group.add(
        "--poses", "SOURCE",
        "live poses: udp:ADDR:PORT, - for stdin, gz:[/TOPIC], ros2:/TOPIC, "
        "rosbridge:ws://HOST:PORT/TOPIC, vda5050:MANUFACTURER/SERIAL for a vehicle at the broker, "
        "or a file played in real time: TUM, EuRoC, KITTI or CSV with a header",
        [&](const auto& text) {
            return put(parse_pose_source(text, fs::current_path()), said.robot.poses);
        });
}

void add_replay(Group& group, SensorConfig& sensor) {
    group
        .add("--replay", "FILE",
             "play this recording in place of a world: MCAP, UBH, CSV, JSON lines, bags of ROS, "
             "rows of numbers, logs of CARMEN, CoreSLAM and Player, .npy or pcap; several files, "
             "or the folder of a bag, are one recording; of several scanners each is served, on "
             "ports "
             "from --tcp on; default: none",
             [&](const auto& text) {
                 if (!sensor.replay) sensor.replay.emplace();
                 return parse_recording(text, fs::current_path()).map([&](const fs::path& file) {
                     sensor.replay->files.push_back(file);
                 });
             })
        ->expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args();
    group
        .add("--loop", "true|on|false",
             "restart it at its end, with the recorded stamps (true) or with stamps that go on "
             "(on); default: false",
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
              "address to listen on, or none; port 0 picks a free port; default: 127.0.0.1:10940",
              [&](const auto& text) { return put(parse_listener(text), sensor.tcp); });
    group.add(
        "--pty", "LINK", "path of its tty, auto or none; default: auto",
        [&](const auto& text) { return put(parse_pty(text, fs::current_path()), sensor.pty); });
    group.add("--backend", "NAME", "auto or one of --list-backends; default: auto",
              [&](const auto& text) { return put(parse_backend(text), sensor.backend); });
    group.add("--accuracy", "ideal|sensor|material",
              "exact geometry, with the scanner's own errors, or also with those that surfaces "
              "cause; default: "
              "sensor",
              [&](const auto& text) { return put(parse_accuracy(text), sensor.accuracy); });
    group.add("--timing", "real|ideal",
              "timing of the real scanner, or immediate answers; default: real",
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
              "share the world with other daemons through this MQTT broker, mqtt://HOST:PORT; "
              "default: not shared",
              [&](const auto& text) { return put(parse_broker(text), over.broker); });
    group.add(
        "--world", "NAME",
        "name of the shared world at the broker; requires --broker. The file of a world is --scene",
        [&](const auto& text) {
            const std::string better = option_for(text);
            if (!better.empty())
                return sim::Expected<>{
                    sim::refuse("names a shared world, not a file; did you mean " + better + "?")};
            return put(parse_world_name(text), over.world);
        });
}

void add_alone(CLI::App& app, OptionValues& said) {
    Group group{app, alone_title};
    group.add("--config", "FILE.yaml",
              "run this configuration; options of the groups World, Daemon and General may be "
              "added and override it",
              [&](const auto& text) { return put<fs::path>(text, said.config); });
    group.add("--check", "FILE",
              "validate a configuration, a world, a map, a mesh, a scenario, materials or a "
              "trajectory: report its contents and every error, then exit",
              [&](const auto& text) { return put<fs::path>(text, said.check); });
    group.add_flag("--list-models", said.list_models,
                   "list the scanners that scipd can emulate, and how certain each figure is");
    group.add_flag("--list-backends", said.list_backends,
                   "list the backends of this build, which compute ranges");
    group.add_flag(
        "--probe", said.probe,
        "report what this machine offers for depth buffers; exit with 1 if it cannot draw");
    app.add_option("--completion", said.completion, "print completions for a shell")
        ->type_name("SHELL")
        ->check(CLI::IsMember(completion_shells()))
        ->group(alone_title);
}

/// The world is that of the options or of the configuration.
void add_map(CLI::App& app, OptionValues& said) {
    Group group{app, map_title};
    group.add("--map", "MAP.yaml",
              "write a ROS map of the world, for AMCL, then exit; the picture MAP.pgm is written "
              "beside it",
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
                 "configuration says, so that two of it run side by side")
        ->group(general_title);
    group.add("--scenario", "FILE",
              "faults to inject into the scanners, and when; default: that of the configuration",
              [&](const auto& text) {
                  return put(parse_file(text, fs::current_path()), said.options.overrides.scenario);
              });
    group.add("--http", "ADDR:PORT",
              "TCP address of the live page and the control API, on loopback, or none; default: "
              "that of the configuration, else none",
              [&](const auto& text) { return put(parse_http(text), said.options.overrides.http); });
}

/// Adds the options that go with all others.
void add_general(CLI::App& app, OptionValues& said) {
    Group group{app, general_title};
    app.add_option("--log-level", said.options.log_level,
                   "least severe messages that are logged on standard error")
        ->check(CLI::IsMember(
            {"trace", "debug", "info", "warning", "warn", "error", "critical", "off"}))
        ->capture_default_str()
        ->group(general_title);
    app.add_option("--log-format", said.options.log_format,
                   "text, or json: one JSON object per line")
        ->type_name("text|json")
        ->check(CLI::IsMember({"text", "json"}))
        ->capture_default_str()
        ->group(general_title);
    app.add_flag("--strict", said.options.overrides.strict,
                 "treat warnings as errors: refuse a world or trajectory that would be read only "
                 "in part, and numbers that look like degrees or millimetres")
        ->group(general_title);
    group.add("--threads", "N",
              "number of threads that run the scanners, or with --clock poses cast their scans; "
              "default: one per processor",
              [&said](const auto& text) { return put(parse_threads(text), said.options.threads); });
    app.set_version_flag("--version", version_of("scipd"), "print the version")
        ->group(general_title);
    app.set_help_flag();
    app.set_help_flag("-h,--help")->group(general_title);
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

std::string option_for(const std::string& file) {
    const std::string extension = sim::extension_of(file);
    if (std::ranges::find(recordings, extension) != recordings.end()) return "--replay " + file;
    const auto kind = kind_of(file);
    if (!kind) return {};
    if (*kind == FileKind::configuration) return "--config " + file;
    if (*kind == FileKind::scenario) return "--scenario " + file;
    if (*kind == FileKind::materials) return "--materials " + file;
    if (*kind != FileKind::trajectory) return "--scene " + file;
    // Any other table of numbers can be a recording.
    return "--poses " + file + (extension == ".tum" ? "" : " or --replay " + file);
}

std::string replacement_for(const std::string& word) {
    for (const auto& [option, names] : foreign_options)
        if (names.find(" " + word + " ") != names.npos) return option;
    return option_for(word);
}

/// Not CLI11's excludes(): it would list every pair in the help.
sim::Expected<> check_together(const CLI::App& app) {
    for (const CLI::Option* alone : app.get_options()) {
        if (alone->get_group() != alone_title || alone->count() == 0) continue;
        for (const CLI::Option* other : app.get_options()) {
            if (other == alone || other->get_group() == general_title || other->count() == 0) {
                continue;
            }
            if (const auto good = check_beside(*alone, *other); !good) return good;
        }
    }
    return {};
}

}  // namespace scipd::daemon
