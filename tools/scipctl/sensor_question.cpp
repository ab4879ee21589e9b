// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/sensor_question.h"

#include <cstdio>

#include <CLI/CLI.hpp>

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

}  // namespace

void explain(ControlClient& client, const std::string& sensor, const ControlError& error) {
    if (error.status() != 404) throw ControlError(error);
    std::string names;
    for (const Json& known : client.get("/sensors")) {
        if (known.at("name") == sensor) throw ControlError(error);
        names.append(names.empty() ? "" : ", ").append(known.at("name").get<std::string>());
    }
    throw ControlError(404, "there is no sensor \"" + sensor + "\"; there are: " + names);
}

std::string sensor_path(const std::string& sensor) {
    const auto slash = sensor.find('/');
    if (slash == std::string::npos) {
        throw CLI::ValidationError("\"" + sensor +
                                   "\" is no sensor: write ROBOT/SENSOR, as `scipctl sensors` "
                                   "lists them");
    }
    return "/sensors/" + path_segment(sensor.substr(0, slash)) + "/" +
           path_segment(sensor.substr(slash + 1));
}

Json ask_sensor(ControlClient& client, const std::string& sensor, const std::string& path) {
    return about_sensor(client, sensor, [&] { return client.get(path); });
}

std::string number(const Json& value, const char* format) {
    if (value.is_null()) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, value.get<double>());
    return text;
}

}  // namespace scipd::tools
