// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/names.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "sim/text/quote.h"

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
    std::vector<std::string> names;
    for (const Json& sensor : client.get("/sensors")) {
        if (is_scanner(sensor) == wants_scanner) names.push_back(sensor.at("name"));
    }
    if (names.size() == 1) return names.front();
    const std::string what = wants_scanner ? "scanner" : "camera or ranger";
    throw ControlError(404, names.empty()
                                ? "there is no " + what
                                : "which " + what + "? Name one of " + sim::listed(names));
}

bool could_be_sensor(const std::string& word) {
    const auto equals = word.find('=');
    return word.substr(0, equals).find('/') != word.npos;
}

void explain(ControlClient& client, const std::string& sensor, const ControlError& error) {
    if (error.status() != 404) throw ControlError(error);
    std::vector<std::string> names;
    for (const Json& known : client.get("/sensors")) {
        if (known.at("name") == sensor) throw ControlError(error);
        names.push_back(known.at("name"));
    }
    throw ControlError(404,
                       "there is no sensor \"" + sensor + "\"; there are: " + sim::listed(names));
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

std::vector<std::string> robots(ControlClient& client) {
    std::vector<std::string> names;
    for (const auto& sensor : client.get("/sensors")) {
        const auto name = sensor.value("name", std::string());
        const std::string robot = name.substr(0, name.find('/'));
        if (std::ranges::find(names, robot) == names.end()) names.push_back(robot);
    }
    return names;
}

std::string choose_robot(ControlClient& client, const std::string& wanted) {
    const auto names = robots(client);
    if (std::ranges::find(names, wanted) != names.end()) return wanted;
    if (wanted.empty() && names.size() == 1) return names.front();
    if (names.empty() && !wanted.empty()) return wanted;
    if (names.empty()) throw ControlError(0, "scipd has no robot with a sensor: name one");
    throw ControlError(
        0, wanted.empty()
               ? "there are several robots; name one of " + sim::listed(names)
               : "there is no robot \"" + wanted + "\"; there are: " + sim::listed(names));
}

std::string pose_path(const std::string& robot) {
    return "/robots/" + path_segment(robot) + "/pose";
}

std::string joined(const Json& names) {
    return names.empty() ? "-" : sim::listed(names.get<std::vector<std::string>>());
}

}  // namespace scipd::tools
