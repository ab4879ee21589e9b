// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/control_client.h"
#include "tools/options.h"
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/table.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

struct TruthOptions {
    std::string sensor;
    std::optional<std::int64_t> scan;
    int from = 0;
    int to = std::numeric_limits<int>::max();
    bool json = false;
};

std::string path_of(const std::string& sensor, const TruthOptions& options) {
    const std::string path = sensor_path(sensor) + "/truth";
    return options.scan ? path + "?scan=" + std::to_string(*options.scan) : path;
}

std::string name(const Json& value) {
    return value.is_null() ? "-" : value.get<std::string>();
}

/// "2.000 m 0.0427 glass, 5.000 m 0.7310 wall": where the light came from, how much, and from what.
std::string echoes(const Json& of_step) {
    std::string text;
    for (const Json& echo : of_step) {
        const Json& material = echo.at("material");
        text.append(text.empty() ? "" : ", ").append(number(echo.at("range_m"), "%.3f m "));
        text.append(number(echo.at("power"), "%.4f "));
        text += material.is_null() ? "in the air" : material.get<std::string>();
    }
    return text.empty() ? "-" : text;
}

/// The numbers of all echoes of a step, if the scanner tells several: "1501 4003".
std::string sent(const Json& truth, std::size_t i, const char* of_one, const char* of_all) {
    if (!truth.contains(of_all)) return truth.at(of_one)[i].dump();
    std::string text;
    for (const Json& value : truth[of_all][i])
        text.append(text.empty() ? "" : " ").append(value.dump());
    return text;
}

Row row_of(const Json& truth, std::size_t i) {
    Row row{truth["steps"][i].dump(), number(truth["true_m"][i], "%.4f"),
            number(truth["incidence_rad"][i], "%.4f"), name(truth["material"][i]),
            name(truth["object"][i])};
    if (truth.contains("echoes")) row.push_back(echoes(truth["echoes"][i]));
    if (truth.contains("bias_m")) row.push_back(number(truth["bias_m"][i], "%+.4f"));
    row.insert(row.end(), {number(truth["read_m"][i], "%.4f"), name(truth["cause"][i]),
                           sent(truth, i, "sent_mm", "sent_echoes_mm"),
                           sent(truth, i, "intensity", "sent_echoes_intensity")});
    return row;
}

void print(const Json& truth, const TruthOptions& options) {
    std::cout << "scan " << truth.at("scan") << ", step 0 at " << number(truth.at("time_s"), "%.6f")
              << " s, stamp " << truth.at("stamp_ms") << " ms, " << truth.at("poses").size()
              << " pose(s), accuracy " << name(truth.at("accuracy"));
    if (truth.at("backend") == "recording")
        std::cout << "\n" << name(truth.at("backend_reason")) << ": the truth is not known";
    std::cout << "\n\n";
    Row head{"STEP", "TRUE m", "INCIDENCE rad", "MATERIAL", "OBJECT"};
    if (truth.contains("echoes")) head.emplace_back("ECHOES");
    if (truth.contains("bias_m")) head.emplace_back("BIAS m");
    head.insert(head.end(), {"READ m", "CAUSE", "SENT mm", "INTENSITY"});
    std::vector<Row> rows{head};
    for (std::size_t i = 0; i < truth.at("steps").size(); ++i) {
        const int step = truth["steps"][i];
        if (step >= options.from && step <= options.to) rows.push_back(row_of(truth, i));
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
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    const Json truth = ask_sensor(client, sensor, path_of(sensor, options));
    if (options.json) {
        std::cout << json_text(truth) << '\n';
    } else {
        truth.contains("steps") ? print(truth, options) : print_staring(truth);
    }
}

}  // namespace

void add_truth_command(CLI::App& program, const ControlOptions& control) {
    auto* const command = program.add_subcommand(
        "truth", "show, for each beam, the ground truth and each stage up to the value sent");
    const auto options = std::make_shared<TruthOptions>();
    command->add_option("SENSOR", options->sensor,
                        "the sensor, as ROBOT/SENSOR; not needed if there is only one scanner");
    command->add_option("--scan", options->scan,
                        "the number of a scan of the last second; default: the latest");
    command->add_option("--from", options->from, "the first step of the table")
        ->check(whole_from(0));
    command->add_option("--to", options->to, "the last step of the table")->check(whole_from(0));
    command->add_flag("--json", options->json, "as a JSON document, with all steps");
    command->callback([&control, options] { show(control, *options); });
}

}  // namespace scipd::tools
