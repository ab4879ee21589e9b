// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipctl scenario: many faults from one file.
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using Json = ControlClient::Json;

constexpr const char* scenario_path = "/scenario";
/// More than any scenario has; a device in the place of a file would have no end.
constexpr std::size_t most_bytes = std::size_t{1} << 20U;

std::string text_in(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(most_bytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad() || !stream.is_open()) throw WrongInput("cannot read " + file);
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most_bytes) throw WrongInput(file + " is too long to be a scenario");
    return text;
}

void run_file(const ControlOptions& control, const std::string& file) {
    const Json request{{"name", fs::path(file).filename().string()}, {"yaml", text_in(file)}};
    (void)ControlClient(control.socket).load(scenario_path, request);
}

void show(const ControlOptions& control, bool json) {
    const Json scenario = ControlClient(control.socket).get(scenario_path);
    if (json) return void(std::cout << json_text(scenario, 2) << '\n');
    std::cout << scenario.at("name").get<std::string>() << ": "
              << scenario.at("state").get<std::string>() << "\n\n";
    std::vector<Row> rows{{"STEP", "SENSOR", "ID", "KIND", "STATE", "HITS"}};
    for (const Json& step : scenario.at("steps")) {
        rows.push_back({step.at("step").dump(), step.at("sensor"), step.at("id").dump(),
                        step.at("kind"), step.at("state"), step.at("hits").dump()});
    }
    print_table(std::cout, rows);
}

}  // namespace

void add_scenario_command(CLI::App& program, const ControlOptions& control) {
    auto* const scenario =
        program.add_subcommand("scenario", "run a scenario of faults from a file");
    scenario->require_subcommand(1);

    auto* const run_command =
        scenario->add_subcommand("run", "start a scenario, replacing the running one");
    const auto file = std::make_shared<std::string>();
    run_command->add_option("FILE", *file, "scenario file, YAML")
        ->required()
        ->check(CLI::ExistingFile);
    run_command->callback([&control, file] { run_file(control, *file); });

    auto* const stop_command = scenario->add_subcommand("stop", "stop the scenario and its faults");
    stop_command->callback([&control] { ControlClient(control.socket).remove(scenario_path); });

    auto* const status_command = scenario->add_subcommand("status", "show its progress");
    const auto json = std::make_shared<bool>(false);
    status_command->add_flag("--json", *json, "as a JSON document");
    status_command->callback([&control, json] { show(control, *json); });
}

}  // namespace scipd::tools
