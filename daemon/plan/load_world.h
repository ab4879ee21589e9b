// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads the world of a configuration from files. Touches nothing that runs: any thread may do it.
#pragma once

#include <stop_token>
#include <string>

#include "daemon/config/config.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/scene_file.h"

namespace scipd::daemon {

/// The world that a configuration names, with the models in it that its robots need. Materials that
/// the library does not know are warnings. Throws LoadError with every fault, or soon after `stop`.
sim::LoadedScene load_world(const Config& config, const sim::SharedMaterials& materials,
                            const std::stop_token& stop = {});

/// The faults of a file, each with the `place` where the configuration names the file.
sim::LoadError named_at(const std::string& place, const sim::LoadError& error);

/// How to load that world, and whatever takes its place or is added to it.
sim::SceneOptions scene_options(const Config& config, const sim::SharedMaterials& materials);

}  // namespace scipd::daemon
