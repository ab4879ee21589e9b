// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl: talks to a running scipd over its control socket.
#include <string>

#include <CLI/CLI.hpp>

#include "daemon/config/run_directory.h"
#include "tools/options.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/which_scipd.h"

namespace {

/// What only the running scipd knows, which the shell asks as somebody types.
scipd::daemon::MoreWords names_from_scipd() {
    const std::string sensors = "$(scipctl sensors --names 2>/dev/null) ";
    const std::string robots = "$(scipctl sensors --robots 2>/dev/null) ";
    const std::string models = "$(scipctl scene list --names 2>/dev/null) ";
    const std::string kinds = "$(scipctl fault kinds --names 2>/dev/null) ";
    return {
        {"/fault/list", sensors},
        {"/fault/log", sensors},
        {"/fault/start", sensors + kinds},
        {"/fault/stop", sensors},
        {"/fleet/move", robots + models},
        {"/fleet/remove", models},
        {"/pose/get", robots},
        {"/pose/play/--robot", robots},
        {"/pose/set", robots},
        {"/pose/stream/--robot", robots},
        {"/reading", sensors},
        {"/replay", sensors + "seek step pause play speed "},
        {"/scene/move", models},
        {"/scene/remove", models},
        {"/sensor/remove", sensors},
        {"/sensor/set", sensors},
        {"/truth", sensors},
    };
}

}  // namespace

int main(int argc, char** argv) {
    using namespace scipd::tools;
    ControlOptions control{.socket = scipd::daemon::run_directory() / "control.sock"};
    CLI::App program("Controls a running scipd.", "scipctl");
    program.require_subcommand(1);
    program.fallthrough();
    const CLI::Option* const named =
        program.add_option("--control", control.socket, "scipd's control socket")
            ->capture_default_str();
    program.parse_complete_callback([&] {
        if (named->empty()) control.socket = socket_of_the_scipd_meant(control.socket);
    });
    add_status_commands(program, control);
    add_top_command(program, control);
    add_pose_commands(program, control);
    add_scene_commands(program, control);
    add_fleet_commands(program, control);
    add_fault_commands(program, control);
    add_scenario_command(program, control);
    add_reading_command(program, control);
    add_replay_command(program, control);
    add_sensor_command(program, control);
    add_truth_command(program, control);
    add_completion_command(program, names_from_scipd());
    program.footer(
        "Examples:\n"
        "  scipctl status\n"
        "  scipctl top\n"
        "  scipctl pose set 1.5,2,0\n"
        "  scipctl pose play lap.tum --speed 2 --loop\n"
        "  scipctl scene add crate crate.stl --scale 0.001 --pose 1,2,0\n"
        "  scipctl fleet status --to mqtt://127.0.0.1:1883/hall\n"
        "  scipctl fault start robot/scanner stall --for s=2\n"
        "  scipctl truth robot/scanner\n"
        "  scipctl reading robot/camera\n"
        "scipctl COMMAND --help shows the options of a command.");
    return run(program, argc, argv);
}
