// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a user should know who most likely gave millimetres for metres, or degrees for radians. Any
// thread; nothing shared.
#pragma once

#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// The warnings of the configuration, and one for each robot and each sensor that lies outside the
/// world as if by millimetres. Sensors that are mounted by name have been given their places
/// (mounting.h). Where it is strict, they are thrown as a sim::LoadError.
std::vector<std::string> warnings_of(const Config& config, const sim::Scene& scene);

}  // namespace scipd::daemon
