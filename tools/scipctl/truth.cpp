// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/scipctl/commands.h"
#include "tools/scipctl/control_client.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

struct TruthOptions {
    std::string sensor;
    std::optional<std::int64_t> scan;
    bool json = false;
};

std::string path_of(const TruthOptions& options) {
    const auto slash = options.sensor.find('/');
    if (slash == std::string::npos) {
        throw CLI::ValidationError("\"" + options.sensor +
                                   "\" is no scanner: write ROBOT/SENSOR, as `scipctl sensors` "
                                   "lists them");
    }
    std::string path = "/sensors/" + path_segment(options.sensor.substr(0, slash)) + "/" +
                       path_segment(options.sensor.substr(slash + 1)) + "/truth";
    if (options.scan) path += "?scan=" + std::to_string(*options.scan);
    return path;
}

std::string number(const Json& value, const char* format) {
    if (value.is_null()) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, value.get<double>());
    return text;
}

std::string name(const Json& value) {
    return value.is_null() ? "-" : value.get<std::string>();
}

void print(const Json& truth) {
    std::cout << "scan " << truth.at("scan") << ", step 0 at " << number(truth.at("time_s"), "%.6f")
              << " s, stamp " << truth.at("stamp_ms") << " ms, " << truth.at("poses").size()
              << " pose(s)\n\n";
    std::vector<Row> rows{
        {"STEP", "TRUE m", "SENT mm", "INTENSITY", "INCIDENCE rad", "MATERIAL", "OBJECT"}};
    for (std::size_t i = 0; i < truth.at("steps").size(); ++i) {
        rows.push_back({truth["steps"][i].dump(), number(truth["true_m"][i], "%.4f"),
                        truth["sent_mm"][i].dump(), truth["intensity"][i].dump(),
                        number(truth["incidence_rad"][i], "%.4f"), name(truth["material"][i]),
                        name(truth["object"][i])});
    }
    print_table(std::cout, rows);
}

/// The same error, unless it was the name that was wrong.
[[noreturn]] void explain(ControlClient& client, const TruthOptions& options,
                          const ControlError& error) {
    std::string names;
    for (const Json& sensor : client.get("/sensors")) {
        if (sensor.at("name") == options.sensor) throw error;
        names.append(names.empty() ? "" : ", ").append(sensor.at("name").get<std::string>());
    }
    throw ControlError(404, "there is no scanner \"" + options.sensor + "\"; there are: " + names);
}

void show(const ControlOptions& control, const TruthOptions& options) {
    const std::string path = path_of(options);
    ControlClient client(control.socket);
    try {
        const Json truth = client.get(path);
        if (!options.json) return print(truth);
        std::cout << truth.dump() << '\n';
    } catch (const ControlError& error) {
        if (error.status() != 404) throw;
        explain(client, options, error);
    }
}

}  // namespace

void add_truth_command(CLI::App& program, const ControlOptions& control) {
    auto* const command =
        program.add_subcommand("truth", "what was true of a scan, beside what was sent");
    const auto options = std::make_shared<TruthOptions>();
    command->add_option("SENSOR", options->sensor, "ROBOT/SENSOR")->required();
    command->add_option("--scan", options->scan, "of the last second; else the latest");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([&control, options] { show(control, *options); });
}

}  // namespace scipd::tools
