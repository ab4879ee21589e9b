// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a scene comes from scipd-read to whoever asked for it. Any thread.
#pragma once

#include <cstdio>

#include "sim/world/scene.h"

namespace scipd::sim {

/// Throws std::bad_alloc if the file has no room.
void put_scene(const Scene& scene, std::FILE* out);
/// The writer may have lost its senses over a file from outside. Throws std::runtime_error where
/// the scene has an index that leads nowhere, or ends early.
Scene take_scene(std::FILE* in);

}  // namespace scipd::sim
