// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "tools/scipctl/control_client.h"

namespace scipd::tools {

/// Of the robots that carry a sensor, each once.
[[nodiscard]] std::vector<std::string> robots(ControlClient& client);

/// `wanted`, or the only robot there is where that is empty. Throws ControlError.
[[nodiscard]] std::string choose_robot(ControlClient& client, const std::string& wanted);

[[nodiscard]] std::string pose_path(const std::string& robot);

}  // namespace scipd::tools
