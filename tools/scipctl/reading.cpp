// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iostream>
#include <memory>
#include <string>

#include "tools/control_client.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

struct ReadingOptions {
    std::string sensor;
    bool json = false;
};

/// Prints how many pixels see something, and which of them is the nearest.
void print_picture(const Json& reading) {
    const auto columns = reading.at("columns").get<std::size_t>();
    const Json& range_m = reading.at("range_m");
    std::size_t seen = 0;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < range_m.size(); ++i) {
        if (range_m[i].is_null()) continue;
        if (seen++ == 0 || range_m[i] < range_m[nearest]) nearest = i;
    }
    std::cout << columns << " x " << reading.at("rows") << " pixels, " << seen << " see something";
    if (seen == 0) return;
    std::cout << ", the nearest at " << number(range_m[nearest], "%.4f") << " m in column "
              << nearest % columns << ", row " << nearest / columns;
}

void print(const Json& reading) {
    std::cout << "scan " << reading.at("scan") << " at " << number(reading.at("time_s"), "%.6f")
              << " s: ";
    if (reading.contains("columns")) {
        print_picture(reading);
    } else if (reading.at("range_m").is_null()) {
        std::cout << "nothing in range";
    } else {
        std::cout << number(reading["range_m"], "%.4f") << " m";
    }
    std::cout << '\n';
}

void show(const ControlOptions& control, const ReadingOptions& options) {
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor, SensorKind::camera_or_ranger);
    const Json reading = ask_sensor(client, sensor, sensor_path(sensor) + "/reading");
    if (!options.json) return print(reading);
    std::cout << json_text(reading) << '\n';
}

}  // namespace

void add_reading_command(CLI::App& program, const ControlOptions& control) {
    auto* const command =
        program.add_subcommand("reading", "show what a camera or a ranger measures");
    const auto options = std::make_shared<ReadingOptions>();
    command->add_option("SENSOR", options->sensor,
                        "the camera or ranger, as ROBOT/SENSOR; not needed if there is only one");
    command->add_flag("--json", options->json, "as a JSON document, with every pixel");
    command->callback([&control, options] { show(control, *options); });
}

}  // namespace scipd::tools
