// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/analysis/scan_table.h"
#include "tools/formatted.h"
#include "tools/options.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"

namespace scipd::tools {
namespace {

using protocol::client::Parameters;
using protocol::client::SensorState;
using protocol::client::Version;

struct InfoOptions {
    ConnectionOptions connection;
    std::vector<std::string> more;
    bool json = false;
};

void line(const char* key, const std::string& value) {
    if (!value.empty()) std::cout << formatted("  %-10s", key) << value << '\n';
}

std::string angles(const Parameters& parameters) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    return formatted("%.2f to %.2f degrees, every %.4g (steps %d to %d, %d looks forward)",
                     parameters.angle_rad(parameters.amin) * degrees,
                     parameters.angle_rad(parameters.amax) * degrees, 360.0 / parameters.ares,
                     parameters.amin, parameters.amax, parameters.afrt);
}

std::string turns(const Parameters& parameters) {
    if (parameters.scan_rpm == 0) return "0 rpm";
    return formatted("%d rpm, a turn in %.4g ms", parameters.scan_rpm,
                     60000.0 / parameters.scan_rpm);
}

std::string clock(const SensorState& state) {
    if (!state.time_ms) return state.time;
    return formatted("%.3f s", *state.time_ms / 1000.0);
}

void print(const ConnectedScanner& scanner, const SensorState& state) {
    const Parameters& parameters = scanner.parameters();
    const Version& version = scanner.version();
    std::cout << scanner.model() << '\n';
    line("product", version.product);
    line("vendor", version.vendor);
    line("serial", version.serial);
    line("firmware", version.firmware);
    line("protocol", version.protocol);
    line("range", formatted("%.3f to %.3f m", parameters.dmin_mm / 1e3, parameters.dmax_mm / 1e3));
    line("angles", angles(parameters));
    line("motor", turns(parameters));
    line("speed", state.motor_speed);
    line("laser", state.laser);
    line("mode", state.mode);
    line("link", state.bit_rate);
    line("clock", clock(state));
    line("health", state.health);
}

nlohmann::ordered_json as_json(const ConnectedScanner& scanner, const SensorState& state) {
    using Json = nlohmann::ordered_json;
    const Parameters& parameters = scanner.parameters();
    const Version& version = scanner.version();
    return {
        {"model", scanner.model()},
        {"vendor", version.vendor},
        {"product", version.product},
        {"firmware", version.firmware},
        {"protocol", version.protocol},
        {"serial", version.serial},
        {"dmin_mm", parameters.dmin_mm},
        {"dmax_mm", parameters.dmax_mm},
        {"ares", parameters.ares},
        {"amin", parameters.amin},
        {"amax", parameters.amax},
        {"afrt", parameters.afrt},
        {"scan_rpm", parameters.scan_rpm},
        {"motor_speed", state.motor_speed},
        {"laser", state.laser},
        {"mode", state.mode},
        {"bit_rate", state.bit_rate},
        {"time", state.time},
        {"time_ms", state.time_ms ? Json(*state.time_ms) : Json(nullptr)},
        {"health", state.health},
    };
}

void show(const InfoOptions& options) {
    std::string target = options.connection.target;
    for (const std::string& file : options.more)
        target += "+" + file;
    if (is_recording(target)) return show_recording(target, options.json);
    if (!options.more.empty())
        throw WrongInput(target + " is not one recording: name a scanner, or files and folders");
    ConnectedScanner scanner = options.connection.open();
    const SensorState state = scanner.driver().state();
    if (!options.json) return print(scanner, state);
    const nlohmann::ordered_json document = as_json(scanner, state);
    std::cout << document.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
}

}  // namespace

void add_info_command(CLI::App& program) {
    auto* const command = program.add_subcommand(
        "info", "show the identity and state of a scanner, or the contents of a recording");
    const auto options = std::make_shared<InfoOptions>();
    options->connection.add_to(*command, Targets::scanners_and_recordings);
    command->add_option("MORE", options->more, "more files of the recording, in order of time");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([options] { show(*options); });
    command->footer(
        "Examples:\n"
        "  scipcat info tcp://192.168.0.10:10940\n"
        "  scipcat info /dev/ttyACM0 --json | jq .serial\n"
        "  scipcat info room.mcap\n"
        "  scipcat info rosbag2_drive               # the folder of a bag\n"
        "  scipcat info drive_0.bag drive_1.bag     # one recording in several files");
}

}  // namespace scipd::tools
