// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/control_client.h"
#include "tools/member_text.h"
#include "tools/options.h"
#include "tools/scipctl/scipctl_commands.h"
#include "tools/scipctl/sensor_question.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

struct SetOptions {
    std::string sensor;
    std::vector<std::string> members;
};

/// The first word may already be a setting.
void leave_sensor_out(SetOptions& options) {
    if (options.sensor.find('=') == std::string::npos) return;
    options.members.insert(options.members.begin(), std::exchange(options.sensor, {}));
}

void set(const ControlOptions& control, const SetOptions& options) {
    if (options.members.empty()) throw WrongInput("say what to set: accuracy=ideal or noise=2");
    Json errors = Json::object();
    for (const std::string& member : options.members)
        add_member(errors, member, "accuracy=ideal or noise=2");
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    const Json now =
        about_sensor(client, sensor, [&] { return client.patch(sensor_path(sensor), errors); });
    std::cout << json_text(now) << '\n';
}

}  // namespace

void add_sensor_command(CLI::App& program, const ControlOptions& control) {
    auto* const sensor = program.add_subcommand("sensor", "change how well a scanner reads");
    sensor->require_subcommand(1);
    auto* const command = sensor->add_subcommand(
        "set", "change accuracy, noise, bias or interference while its clients go on");
    const auto options = std::make_shared<SetOptions>();
    command->add_option("SENSOR", options->sensor,
                        "the scanner, as ROBOT/SENSOR; not needed if there is only one");
    command->add_option("SETTING", options->members,
                        "accuracy=ideal|sensor|material, noise=0 to 100 times the model's, "
                        "bias=none|unit or a list of points, interference=true|false");
    command->callback([&control, options] {
        leave_sensor_out(*options);
        set(control, *options);
    });
    command->footer(
        "Examples:\n"
        "  scipctl sensor set rescue/front accuracy=ideal\n"
        "  scipctl sensor set rescue/front noise=2 bias=none");
}

}  // namespace scipd::tools
