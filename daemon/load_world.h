// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include "daemon/config/config.h"
#include "sim/loaders/loaded_scene.h"

namespace scipd::daemon {

/// The world that a configuration names, with the models in it that its robots need. Touches
/// nothing that runs: any thread may do it. Throws LoadError with every fault.
sim::LoadedScene load_world(const Config& config);

/// Another one, as a configuration that says nothing more of it would have it.
sim::LoadedScene load_world_file(const std::filesystem::path& file);

}  // namespace scipd::daemon
