// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string>
#include <vector>

#include "tools/control_client.h"

namespace scipd::tools {

/// The robots that carry a sensor, each once.
[[nodiscard]] std::vector<std::string> robots(ControlClient& client);

/// Returns `wanted`; if that is empty, the only robot. Throws ControlError if there is not exactly
/// one.
[[nodiscard]] std::string choose_robot(ControlClient& client, const std::string& wanted);

[[nodiscard]] std::string pose_path(const std::string& robot);

}  // namespace scipd::tools
