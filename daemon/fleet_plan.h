// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration on its way to a running fleet: its world is loaded and ready to be cast into.
// Touches nothing that runs, so that any thread may do it.
#pragma once

#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/control/sensor_backends.h"
#include "sim/loaders/loaded_scene.h"

namespace scipd::daemon {

struct FleetPlan {
    Config config;
    sim::LoadedScene loaded;
    SensorBackends backends;
};

/// How "auto" is settled.
enum class AutoBackend {
    rays,      ///< for now, without a look at the others
    measured,  ///< takes some tenths of a second
};

/// Throws LoadError, and std::runtime_error where this machine has not a backend that is wanted.
FleetPlan make_plan(Config config, AutoBackend auto_backend = AutoBackend::rays);

/// What a sensor of a robot that is there asks of the backends. In lockstep, where two runs have to
/// be the same, "auto" is settled from the first.
BackendWish backend_wish(const std::string& robot, const SensorConfig& sensor,
                         const sim::Pose& world_from_robot, ClockKind clock);

}  // namespace scipd::daemon
