// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A configuration on its way to a running rig: its world is loaded and ready to be cast into, and
// so is whatever else is read from files. Touches nothing that runs, so that any thread may do it.
#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/faults/scenario.h"
#include "daemon/fleet/join_world.h"
#include "daemon/plan/homes.h"
#include "daemon/plan/known_sensors.h"
#include "daemon/plan/load_tapes.h"
#include "daemon/plan/load_world.h"
#include "daemon/world/edited_scene.h"
#include "daemon/world/requested_backend.h"
#include "daemon/world/sensor_backends.h"
#include "sim/loaders/file/loaded_scene.h"
#include "sim/world/material_library.h"

namespace scipd::daemon {

/// A world that goes on as people have made it, whatever its file says.
struct KeptWorld {
    sim::SharedScene scene;
    sim::SharedMaterials materials;
};

/// What runs by now: it need not be found out or read again.
struct Running {
    KnownSensors sensors;
    Homes homes;
    PlayedSources played;
    /// Nothing: the world is loaded anew, and begins as the configuration says.
    std::optional<KeptWorld> world = {};
};

struct RigPlan {
    /// The world goes on, and so does what was changed while it ran: media, how scanners read, the
    /// scenario. Only sensors and robots come and go.
    bool world_goes_on = false;
    Config config;
    Homes homes;
    sim::LoadedScene loaded;
    SensorBackends backends;
    std::vector<std::string> notices;  ///< no faults
    sim::SharedMaterials materials;
    std::optional<Scenario> scenario;
    LoadedTrajectories trajectories;
    Tracks tracks;
    AddedTriangles added;  ///< by daemons that share the world
    /// Why what they have changed could not be made here, by model.
    std::map<std::string, std::string> unlike_the_others;
    sim::Time scripts_age{};  ///< how long ago the scripts of the world began
};

/// Where nothing is settled yet, `auto` takes the preferred backend for now. Throws LoadError, also
/// soon after `stop`, and std::runtime_error where this machine lacks a backend that is wanted.
/// `join` makes the world the one that is shared with others, and throws what it throws.
RigPlan make_plan(Config config, const Running& running = {}, const std::stop_token& stop = {},
                  const JoinWorld& join = {});

/// What a sensor asks of the backends while its robot is at this pose. In lockstep two runs have to
/// be the same, so there `auto` is settled from the first. `materials` are those of the world.
RequestedBackend requested_backend(const std::string& robot, const SensorConfig& sensor,
                                   const sim::Pose& world_from_robot, ClockKind clock,
                                   const sim::SharedMaterials& materials);

}  // namespace scipd::daemon
