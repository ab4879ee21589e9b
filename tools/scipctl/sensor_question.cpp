// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/sensor_question.h"

#include <cstdio>

#include <CLI/CLI.hpp>

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// Cameras and rangers have nothing to connect to.
bool is_scanner(const Json& sensor) {
    return !sensor.at("tcp").is_null() || !sensor.at("pty").is_null();
}

}  // namespace

std::string choose_sensor(ControlClient& client, const std::string& said, SensorKind kind) {
    if (!said.empty()) return said;
    const bool wants_scanner = kind == SensorKind::scanner;
    std::string names;
    std::string only;
    std::size_t count = 0;
    for (const Json& sensor : client.get("/sensors")) {
        if (is_scanner(sensor) != wants_scanner) continue;
        only = sensor.at("name").get<std::string>();
        names.append(names.empty() ? "" : ", ").append(only);
        ++count;
    }
    if (count == 1) return only;
    const std::string what = wants_scanner ? "scanner" : "camera or ranger";
    throw ControlError(
        404, count == 0 ? "there is no " + what : "which " + what + "? Name one of " + names);
}

bool could_be_sensor(const std::string& word) {
    const auto equals = word.find('=');
    return word.substr(0, equals).find('/') != word.npos;
}

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
