// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads the files that a configuration names: world, materials, trajectories, scenario. Touches
// nothing that runs. Any thread.
#pragma once

#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/config/config.h"
#include "daemon/faults/scenario.h"
#include "daemon/poses/read_trajectory.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/scene_file.h"
#include "sim/world/material_library.h"

namespace scipd::daemon {

/// The world that a configuration names, with the models in it that its robots need. Materials that
/// the library does not know are warnings. Throws LoadError with every fault, or soon after `stop`.
sim::LoadedScene load_world(const Config& config, const sim::SharedMaterials& materials,
                            const std::stop_token& stop = {});

/// The faults of a file, each with the `place` where the configuration names the file.
sim::LoadError named_at(const std::string& place, const sim::LoadError& error);

/// Options to load that world, and whatever takes its place or is added to it.
sim::SceneOptions scene_options(const Config& config, const sim::SharedMaterials& materials);

/// Returns nullopt if the configuration names none. Throws sim::LoadError with every fault.
std::optional<Scenario> load_scenario(const Config& config);

struct LoadedMaterials {
    sim::SharedMaterials library;
    std::vector<std::string> warnings;
};

/// The library that comes with scipd, to which the file adds that the configuration names, and
/// whose entries it replaces. Where the first is not installed, that is a warning, and a fault in a
/// strict configuration. Throws sim::LoadError with every fault of either file.
LoadedMaterials load_materials(const Config& config);

/// "34 (84 % of 178 numbers assumed)"
std::string summary_of(const sim::MaterialLibrary& library);

/// The sources of the poses that robots play, by robot.
using PlayedSources = std::map<std::string, PoseSource>;

struct LoadedTrajectories {
    std::map<std::string, PlayedPoses> poses;  ///< by robot
    std::vector<std::string> warnings;
};

/// But for those that are played already. Where the configuration is strict, warnings are faults.
/// Throws sim::LoadError with every fault, or soon after `stop`.
LoadedTrajectories load_trajectories(const Config& config, const PlayedSources& played = {},
                                     const std::stop_token& stop = {});

}  // namespace scipd::daemon
