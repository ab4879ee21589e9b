// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the places of named mounts in a world that is loaded. Touches nothing that runs: any thread
// may do it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// Gives each sensor whose mount is a name its pose on the robot. A robot with such a sensor has
/// the model around that place as its body, if that can move and no body is named, and starts where
/// the model stands, if no pose is given. Answers with what there is to say of it: which product
/// comes closest to the lidar that is there. Throws LoadError with every name that is not there or
/// is not one place.
std::vector<std::string> mount_by_name(Config& config, const sim::Scene& scene);

/// The pose of a sensor that has been mounted before, in another world; nothing where that world has
/// no such place.
std::optional<sim::Pose> mounted_again(const NamedMount& mount, const sim::Scene& scene);

}  // namespace scipd::daemon
