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
#include "tools/scipctl/names.h"
#include "tools/scipctl/scipctl_commands.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

constexpr const char* of_a_sensor = "model=UST-10LX or tcp=127.0.0.1:0";

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
    if (options.members.empty())
        throw WrongInput("name what to set, such as accuracy=ideal or noise=2");
    Json errors = Json::object();
    for (const std::string& member : options.members)
        add_member(errors, member, "accuracy=ideal or noise=2");
    ControlClient client(control.socket);
    const std::string sensor = choose_sensor(client, options.sensor);
    const Json now =
        about_sensor(client, sensor, [&] { return client.patch(sensor_path(sensor), errors); });
    std::cout << json_text(now) << '\n';
}

void add_sensor(const ControlOptions& control, const SetOptions& options) {
    Json sensor{{"name", options.sensor}};
    for (const std::string& member : options.members)
        add_member(sensor, member, of_a_sensor);
    ControlClient client(control.socket);
    const Json answer = client.post("/sensors", sensor);
    for (const Json& warning : answer.at("warnings"))
        std::cerr << "scipctl: " << warning.get<std::string>() << '\n';
    std::cout << json_text(answer.at("sensor")) << '\n';
}

void remove_sensor(const ControlOptions& control, const std::string& sensor) {
    ControlClient client(control.socket);
    about_sensor(client, sensor, [&] { client.remove(sensor_path(sensor)); });
}

void add_sensor_add(CLI::App& sensor, const ControlOptions& control) {
    auto* const command =
        sensor.add_subcommand("add", "add a sensor to an existing or a new robot");
    const auto options = std::make_shared<SetOptions>();
    command->add_option("SENSOR", options->sensor, "its name, as ROBOT/SENSOR")->required();
    command
        ->add_option("KEY=VALUE", options->members,
                     "the keys of a sensor in a configuration: model, tcp, pty, mount, accuracy "
                     "and more; and pose, that of a new robot")
        ->required();
    command->callback([&control, options] { add_sensor(control, *options); });
    command->footer(
        "Examples:\n"
        "  scipctl sensor add rescue/left model=URG-04LX pty=auto mount.xyz='[0, 0.2, 0.2]'\n"
        "  scipctl sensor add other/front model=UST-20LX tcp=127.0.0.1:0 pose.xyz='[1, 2, 0]'");
}

void add_sensor_remove(CLI::App& sensor, const ControlOptions& control) {
    auto* const command =
        sensor.add_subcommand("remove", "remove a sensor; a robot is removed with its last one");
    const auto name = std::make_shared<std::string>();
    command->add_option("SENSOR", *name, "its name, as ROBOT/SENSOR")->required();
    command->callback([&control, name] { remove_sensor(control, *name); });
}

void add_sensor_set(CLI::App& sensor, const ControlOptions& control) {
    auto* const command = sensor.add_subcommand(
        "set", "change accuracy, noise, bias or interference while its clients stay connected");
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

}  // namespace

void add_sensor_command(CLI::App& program, const ControlOptions& control) {
    auto* const sensor = program.add_subcommand(
        "sensor", "add or remove a sensor, or change its accuracy and noise");
    sensor->require_subcommand(1);
    add_sensor_set(*sensor, control);
    add_sensor_add(*sensor, control);
    add_sensor_remove(*sensor, control);
}

}  // namespace scipd::tools
