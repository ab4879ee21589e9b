// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdio>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/text/quote.h"
#include "tools/control_client.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// A field for people. A dash stands for null, and for fields that an older scipd does not send.
std::string text(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || object[key].is_null()) return "-";
    const Json& value = object[key];
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number_float()) return value.dump();
    char number[32];
    std::snprintf(number, sizeof number, "%.2f", value.get<double>());
    return number;
}

std::string lateness(const Json& sensor) {
    const Json late = sensor.value("lateness_ms", Json());
    return text(late, "p50") + " / " + text(late, "p99") + " / " + text(late, "max");
}

/// The kinds of those that act now.
std::string faults(const Json& sensor) {
    std::set<std::string> kinds;
    for (const Json& kind : sensor.value("faults", Json::array()))
        kinds.insert(kind.get<std::string>());
    return kinds.empty() ? "-" : sim::listed(kinds);
}

void print_sensors(const Json& sensors) {
    std::vector<Row> rows{{"SENSOR", "MODEL", "BACKEND", "STATE", "FAULTS", "CLIENTS", "SCANS",
                           "LOST", "STREAM LOST", "LATE p50/p99/max ms", "TCP", "TTY"}};
    for (const Json& sensor : sensors) {
        rows.push_back({text(sensor, "name"), text(sensor, "model"), text(sensor, "backend"),
                        text(sensor, "state"), faults(sensor), text(sensor, "clients"),
                        text(sensor, "scans"), text(sensor, "lost"), text(sensor, "stream_lost"),
                        lateness(sensor), text(sensor, "tcp"), text(sensor, "pty")});
    }
    print_table(std::cout, rows);
    for (const Json& sensor : sensors) {
        const Json connected = sensor.value("connected", Json::array());
        for (const Json& client : sensor.value("waiting", Json::array())) {
            std::cout << text(sensor, "name") << ": client from " << client.get<std::string>()
                      << " waits until "
                      << (connected.empty() ? "another one" : connected[0].get<std::string>())
                      << " disconnects: a scanner serves one TCP client at a time\n";
        }
        const std::string warning = text(sensor, "warning");
        if (warning != "-")
            std::cout << "warning: " << text(sensor, "name") << ": " << warning << '\n';
    }
}

void print_status(const Json& status) {
    const Json poses = status.value("poses", Json());
    std::cout << "scene   " << (status.at("scene") == "" ? "none" : text(status, "scene")) << '\n'
              << "clock   " << text(status, "clock") << ", " << text(status, "time_s")
              << " s; up for " << text(status, "uptime_s") << " s\n"
              << "poses   " << text(poses, "accepted") << " accepted, " << text(poses, "refused")
              << " refused";
    if (const std::string why = text(poses, "last_refusal"); why != "-") {
        std::cout << " (the last: " << why << ")";
    }
    std::cout << "\n\n";
    print_sensors(status.value("sensors", Json::array()));
}

struct ShownOptions {
    bool json = false;
    bool names = false;
    bool robots = false;
};

/// The names alone, one a line, as completions want them.
void print_names(ControlClient& client, const ShownOptions& options) {
    if (options.robots) {
        for (const std::string& robot : robots(client))
            std::cout << robot << '\n';
    }
    if (!options.names) return;
    for (const Json& sensor : client.get("/sensors"))
        std::cout << text(sensor, "name") << '\n';
}

/// Adds `scipctl NAME`, which shows the document at /NAME.
std::pair<CLI::App*, std::shared_ptr<ShownOptions>> add_command(CLI::App& program,
                                                                const ControlOptions& control,
                                                                const std::string& name,
                                                                const std::string& description,
                                                                void (*print)(const Json&)) {
    auto* const command = program.add_subcommand(name, description);
    const auto options = std::make_shared<ShownOptions>();
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([=, &control] {
        ControlClient client(control.socket);
        if (options->names || options->robots) return print_names(client, *options);
        const Json document = client.get("/" + name);
        if (!options->json) return print(document);
        std::cout << json_text(document, 2) << '\n';
    });
    return {command, options};
}

}  // namespace

void add_status_commands(CLI::App& program, const ControlOptions& control) {
    add_command(program, control, "status", "show the state of scipd and its sensors",
                print_status);
    const auto [sensors, options] =
        add_command(program, control, "sensors", "list the sensors", print_sensors);
    sensors->add_flag("--names", options->names, "their names alone, one a line");
    sensors->add_flag("--robots", options->robots, "the names of the robots alone, one a line");
}

}  // namespace scipd::tools
