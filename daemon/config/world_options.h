// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads how a world is to be loaded: `map: {z: [BOTTOM, TOP], material: NAME, unknown: ..}` for
// what a ROS map does not say of its walls, `xacro: {NAME: VALUE}` for the arguments of a world in
// xacro, and `limits: {world_memory_mb: 8000, world_triangles:
// 50000000, world_load_s: 900}` for what a world may take. The limits of clients stand under
// `limits`, too. Any thread; nothing shared.
#pragma once

#include "daemon/config/config.h"
#include "sim/loaders/map/map_options.h"
#include "sim/loaders/scene_file.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// `field` is the value of the root's key `map`.
sim::MapOptions read_map(const sim::YamlField& field, sim::YamlFaults& faults);

/// `field` is the value of the root's key `xacro`.
sim::XacroArguments read_xacro(const sim::YamlField& field, sim::YamlFaults& faults);

/// `field` is the value of the root's key `limits`.
void read_limits(const sim::YamlField& field, Config& config, sim::YamlFaults& faults);

/// Sets the limits for all that is loaded with these options. One mesh of a world may be as large
/// as all of it. The memory is what a world may take, and what the readers of its meshes may take
/// at a time.
void apply(const WorldLimits& limits, sim::SceneOptions& options);

}  // namespace scipd::daemon
