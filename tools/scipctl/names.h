// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Names of robots and sensors that a user gave or left out, and requests about them. One thread.
#pragma once

#include <string>
#include <vector>

#include "tools/control_client.h"

namespace scipd::tools {

enum class SensorKind { scanner, camera_or_ranger };

/// `said`; if that is empty, the only sensor of this kind. Throws ControlError if there is not
/// exactly one.
[[nodiscard]] std::string choose_sensor(ControlClient& client, const std::string& said,
                                        SensorKind kind = SensorKind::scanner);

/// Whether a word could be the name of a sensor, ROBOT/SENSOR, and is no KEY=VALUE.
[[nodiscard]] bool could_be_sensor(const std::string& word);

/// "/sensors/rescue/front" for "rescue/front". Throws CLI::ValidationError for other text.
[[nodiscard]] std::string sensor_path(const std::string& sensor);

/// Sends GET for a path that begins with that. Throws ControlError; if the name is wrong, the error
/// lists the right ones.
[[nodiscard]] ControlClient::Json ask_sensor(ControlClient& client, const std::string& sensor,
                                             const std::string& path);

/// Throws the same error again; if the name of the sensor is wrong, one that lists the right names.
[[noreturn]] void explain(ControlClient& client, const std::string& sensor,
                          const ControlError& error);

/// Makes any other request about a sensor, with the same errors.
template <class Request>
auto about_sensor(ControlClient& client, const std::string& sensor, Request request) {
    try {
        return request();
    } catch (const ControlError& error) {
        explain(client, sensor, error);
    }
}

/// A number, or a dash for null.
[[nodiscard]] std::string number(const ControlClient::Json& value, const char* format);

/// The robots that carry a sensor, each once.
[[nodiscard]] std::vector<std::string> robots(ControlClient& client);

/// Returns `wanted`; if that is empty, the only robot. Throws ControlError with the names of all if
/// there is no such robot, or not exactly one.
[[nodiscard]] std::string choose_robot(ControlClient& client, const std::string& wanted);

[[nodiscard]] std::string pose_path(const std::string& robot);

/// Names with commas between them, or a dash for none.
[[nodiscard]] std::string joined(const ControlClient::Json& names);

}  // namespace scipd::tools
