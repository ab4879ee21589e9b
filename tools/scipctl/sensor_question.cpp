// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/sensor_question.h"

#include <cstdio>

#include <CLI/CLI.hpp>

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// Throws the same error again; if the name is wrong, one that lists the right names.
[[noreturn]] void explain(ControlClient& client, const std::string& name,
                          const ControlError& error) {
    std::string names;
    for (const Json& sensor : client.get("/sensors")) {
        if (sensor.at("name") == name) throw error;
        names.append(names.empty() ? "" : ", ").append(sensor.at("name").get<std::string>());
    }
    throw ControlError(404, "there is no sensor \"" + name + "\"; there are: " + names);
}

}  // namespace

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
    try {
        return client.get(path);
    } catch (const ControlError& error) {
        if (error.status() != 404) throw;
        explain(client, sensor, error);
    }
}

std::string number(const Json& value, const char* format) {
    if (value.is_null()) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, value.get<double>());
    return text;
}

}  // namespace scipd::tools
