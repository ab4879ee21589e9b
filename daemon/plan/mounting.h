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
#include "daemon/plan/known_sensors.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

/// Gives each sensor whose mount is a name its pose on the robot. The model around that place
/// becomes the robot's body, if the model can move and the configuration names no body. The robot
/// starts where the model stands, if the configuration gives no pose. Returns notes for people:
/// which product comes closest to the lidar that is there. Throws LoadError with every name that is
/// not there or is not one place. Sensors that are `mounted` stay where they are.
std::vector<std::string> mount_by_name(Config& config, const sim::Scene& scene,
                                       const KnownSensors& mounted = {});

/// The pose of a mount that was found in another world before; nothing: this world has no such
/// place.
std::optional<sim::Pose> mounted_again(const NamedMount& mount, const sim::Scene& scene);

}  // namespace scipd::daemon
