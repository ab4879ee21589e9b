// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/program/parse_options.h"

#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "daemon/command_line/help_text.h"
#include "daemon/command_line/unknown_word.h"
#include "daemon/config/config_file.h"
#include "daemon/config/demo_world.h"
#include "daemon/config/sensor.h"
#include "daemon/program/check.h"
#include "daemon/program/option_groups.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/scene_file.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr const char* description =
    "emulates a Hokuyo laser scanner: programs cannot tell the difference. It speaks SCIP\n"
    "over TCP and a tty, and its ranges come from a 3D world. Without options it is a UST-10LX in\n"
    "the demo world. Once everything is ready, it prints one line of JSON with the addresses.";

constexpr const char* examples = R"(Examples:
  scipd
        a UST-10LX at the start of the rescue maze, on 127.0.0.1:10940 and a tty
  scipd --scene room.sdf --model URG-04LX --tcp none --pty /tmp/urg
        a URG-04LX on a tty alone, for a driver that opens /tmp/urg
  scipd --scene room.sdf --pose 2,1.5,3.14 --poses udp:127.0.0.1:14550
        starts at x 2 m, y 1.5 m, looking along -x, and then follows the poses sent by UDP
  scipd --poses scenes/rescue_maze.tum --accuracy ideal
        drives through the maze, without noise
  scipd --config rig.yaml
        any number of robots and scanners; scipd --check rig.yaml reports every error in it

Lengths are metres, angles radians; x is forward, y left, z up.
Exit codes: 0 stopped as requested; 1 failed while running, or --probe cannot draw here,
or at the start the broker did not answer or the machine lacked an address to listen on;
2 the options, the configuration or the world are wrong, or an address or a name is taken.)";

Answer refusal(const std::string& sentence) {
    return {2, sentence + "\n"};
}

Answer wrong_options(const std::string& why) {
    return refusal("scipd: " + why);
}

/// For an option whose name or form is wrong; help does not help with a value.
Answer unknown_options(const std::string& why) {
    return wrong_options(why + (why.ends_with('?') ? "" : "; see scipd --help"));
}

/// A world is shared where both is said: how, and which.
sim::Expected<> check_fleet(const Config& config) {
    if (config.fleet && (config.fleet->broker.host.empty() || config.fleet->world.empty()))
        return sim::refuse(
            "--broker and --world go together: they share a world. A world is loaded by --scene "
            "FILE");
    for (const RobotConfig& robot : config.robots) {
        if (!config.fleet && robot.poses && robot.poses->kind == PoseSource::Kind::vda5050)
            return sim::refuse("--poses vda5050: goes with --broker and --world");
    }
    return {};
}

/// Gives options that were left out the values that the help names.
sim::Expected<> complete(OptionValues& said) {
    Config& config = said.options.config;
    auto& replay = said.sensor.replay;
    if (replay) replay->finds_model = !said.model_given;
    if (replay) replay->serves_all = true;
    const bool demo = config.scene.empty() && !replay;
    if (demo) {
        const auto scene = demo_scene();
        if (!scene) return tl::unexpected(scene.error());
        config.scene = *scene;
    }
    if (demo && !said.start_given) said.robot.world_from_robot = demo_start();
    said.robot.pose_given = demo || said.start_given;
    if (demo && !said.mount_given) said.sensor.robot_from_sensor = demo_mount();
    auto& mount = said.sensor.mount;
    if (mount) mount->chooses_model = mount->kind == MountKind::lidar && !said.model_given;

    said.robot.sensors = {said.sensor};
    config.robots = {said.robot};
    config.allow = {sim::folder_of_scene(config.scene), fs::current_path()};
    if (!said.sensor.tcp && !said.sensor.pty)
        return sim::refuse("--tcp none and --pty none: no driver could reach the scanner");
    if ((mount && mount->chooses_model) || (replay && replay->finds_model)) return {};
    const auto good = check_power_up(said.sensor.power_up, said.sensor.model.profile);
    if (!good) return sim::refuse("--power-up: " + good.error().why);
    return {};
}

std::variant<Options, Answer> act(OptionValues& said) {
    if (said.list_models) return model_list();
    if (said.list_backends) return backend_list();
    if (said.probe) return probe();
    if (!said.check.empty()) return Answer{0, check(said.check, said.options)};
    Config& config = said.options.config;
    if (!said.config.empty()) {
        const std::string better = option_for(said.config);
        if (!better.empty() && !better.starts_with("--config "))
            return wrong_options("--config: " + sim::quote(said.config.native()) +
                                 " is not a configuration; did you mean " + better + "?");
        config = load_config(said.config);
        said.options.config_file = fs::absolute(said.config);
    }
    said.options.overrides.put_into(config);
    const auto good = (said.config.empty() ? complete(said) : sim::Expected<>{}).and_then([&] {
        return check_fleet(config);
    });
    if (!good) return wrong_options(good.error().why);
    if (!said.map.file.empty()) return write_map(config, said.map);
    if (said.map.heights || said.map.resolution_m)
        return wrong_options("--map-z and --map-resolution go with --map MAP.yaml");
    return std::move(said.options);
}

}  // namespace

std::variant<Options, Answer> parse_options(int argc, const char* const* argv) {
    CLI::App app{description, "scipd"};
    app.footer(examples);
    OptionValues said;
    add_options(app, said);
    use_our_help(app);
    try {
        app.parse(argc, argv);
        if (const auto good = check_together(app); !good) return wrong_options(good.error().why);
        if (!said.completion.empty()) return completion_script(app, said.completion);
        return act(said);
    } catch (const CLI::CallForHelp&) {
        return Answer{0, app.help()};
    } catch (const CLI::CallForVersion& version) {
        return Answer{0, std::string{version.what()} + "\n"};
    } catch (const CLI::ExtrasError& error) {
        return unknown_options(unknown_word(app, replacement_for).value_or(error.what()));
    } catch (const CLI::ValidationError& error) {
        return wrong_options(error.what());
    } catch (const CLI::ParseError& error) {
        return unknown_options(error.what());
    } catch (const sim::LoadError& error) {
        return refusal(error.what());
    } catch (const std::exception& error) {
        return wrong_options(error.what());
    }
}

}  // namespace scipd::daemon
