// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What scipd-read does for a request: chooses the loader by the kind of the file. Any thread;
// nothing shared.
#pragma once

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/reader/scene_request.h"

namespace scipd::sim {

/// Throws LoadError.
LoadedScene read_scene(const SceneRequest& request);

}  // namespace scipd::sim
