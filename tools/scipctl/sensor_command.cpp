// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tools/control_client.h"
#include "tools/scipctl/commands.h"
#include "tools/scipctl/fault_text.h"
#include "tools/scipctl/sensor_question.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

struct SetOptions {
    std::string sensor;
    std::vector<std::string> members;
};

void set(const ControlOptions& control, const SetOptions& options) {
    Json errors = Json::object();
    for (const std::string& member : options.members)
        add_member(errors, member, "accuracy=ideal or noise=2");
    const std::string path = sensor_path(options.sensor);
    ControlClient client(control.socket);
    const Json now =
        about_sensor(client, options.sensor, [&] { return client.patch(path, errors); });
    std::cout << json_text(now) << '\n';
}

}  // namespace

void add_sensor_command(CLI::App& program, const ControlOptions& control) {
    auto* const sensor = program.add_subcommand("sensor", "change how well a scanner reads");
    sensor->require_subcommand(1);
    auto* const command = sensor->add_subcommand(
        "set", "change accuracy, noise, bias or interference while its clients go on");
    const auto options = std::make_shared<SetOptions>();
    command->add_option("SENSOR", options->sensor, "the scanner, as ROBOT/SENSOR")->required();
    command
        ->add_option("SETTING", options->members,
                     "accuracy=ideal|sensor|material, noise=0 to 100 times the model's, "
                     "bias=none|unit or a list of points, interference=true|false")
        ->required();
    command->callback([&control, options] { set(control, *options); });
    command->footer(
        "Examples:\n"
        "  scipctl sensor set rescue/front accuracy=ideal\n"
        "  scipctl sensor set rescue/front noise=2 bias=none");
}

}  // namespace scipd::tools
