// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/scipctl/commands.h"
#include "tools/scipctl/control_client.h"
#include "tools/scipctl/sensor_question.h"
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
    const std::string path = sensor_path(options.sensor) + "/truth";
    return options.scan ? path + "?scan=" + std::to_string(*options.scan) : path;
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

/// For a camera or a ranger. Its beams have no steps, and a ranger has one reading for all of them.
void print_staring(const Json& truth) {
    const Json& range_m = truth.at("range_m");
    std::cout << "scan " << truth.at("scan") << " at " << number(truth.at("time_s"), "%.6f")
              << " s, " << truth.at("poses").size() << " pose(s)";
    if (!range_m.is_array()) std::cout << ", says " << number(range_m, "%.4f") << " m";
    std::cout << "\n\n";
    std::vector<Row> rows{{"BEAM", "TRUE m", "SAYS m", "INCIDENCE rad", "MATERIAL", "OBJECT"}};
    for (std::size_t i = 0; i < truth.at("true_m").size(); ++i) {
        rows.push_back({std::to_string(i), number(truth["true_m"][i], "%.4f"),
                        range_m.is_array() ? number(range_m[i], "%.4f") : "-",
                        number(truth["incidence_rad"][i], "%.4f"), name(truth["material"][i]),
                        name(truth["object"][i])});
    }
    print_table(std::cout, rows);
}

void show(const ControlOptions& control, const TruthOptions& options) {
    const std::string path = path_of(options);
    ControlClient client(control.socket);
    const Json truth = ask_sensor(client, options.sensor, path);
    if (options.json) {
        std::cout << json_text(truth) << '\n';
    } else {
        truth.contains("steps") ? print(truth) : print_staring(truth);
    }
}

}  // namespace

void add_truth_command(CLI::App& program, const ControlOptions& control) {
    auto* const command = program.add_subcommand(
        "truth", "show the true ranges of a scan, beside what the scanner sent");
    const auto options = std::make_shared<TruthOptions>();
    command->add_option("SENSOR", options->sensor, "the sensor, as ROBOT/SENSOR")->required();
    command->add_option("--scan", options->scan,
                        "the number of a scan of the last second; default: the latest");
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([&control, options] { show(control, *options); });
}

}  // namespace scipd::tools
