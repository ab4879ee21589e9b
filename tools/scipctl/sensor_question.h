// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Questions to one sensor that a user names. One thread.
#pragma once

#include <string>

#include "tools/scipctl/control_client.h"

namespace scipd::tools {

/// "/sensors/rescue/front" for "rescue/front". Throws CLI::ValidationError where that is no name.
[[nodiscard]] std::string sensor_path(const std::string& sensor);

/// GET of what begins with that path. Throws ControlError; where it was the name that was wrong,
/// with the right ones.
[[nodiscard]] ControlClient::Json ask_sensor(ControlClient& client, const std::string& sensor,
                                             const std::string& path);

/// A number or, for null, a dash.
[[nodiscard]] std::string number(const ControlClient::Json& value, const char* format);

}  // namespace scipd::tools
