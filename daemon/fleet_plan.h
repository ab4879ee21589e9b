// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration on its way to a running fleet: its world is loaded and ready to be cast into.
// Touches nothing that runs, so that any thread may do it.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/world/sensor_backends.h"
#include "sim/loaders/file/loaded_scene.h"

namespace scipd::daemon {

struct FleetPlan {
    Config config;
    sim::LoadedScene loaded;
    SensorBackends backends;
    std::vector<std::string> notices;  ///< no faults
};

/// What "auto" has been settled as, by sensor: good for one that is still the same.
struct SettledBackend {
    SensorConfig config;
    SharedChoice choice;
};
using SettledBackends = std::map<std::string, SettledBackend>;

/// "auto" is rays where nothing is settled, for now. Throws LoadError, also soon after `stop`, and
/// std::runtime_error where this machine has not a backend that is wanted.
FleetPlan make_plan(Config config, const SettledBackends& settled = {},
                    const std::stop_token& stop = {});

/// What a sensor of a robot that is there asks of the backends. In lockstep, where two runs have to
/// be the same, "auto" is settled from the first.
BackendWish backend_wish(const std::string& robot, const SensorConfig& sensor,
                         const sim::Pose& world_from_robot, ClockKind clock);

}  // namespace scipd::daemon
