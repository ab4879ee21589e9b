// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has scipd-read read a world or a model: a program of its own, since the files come from outside
// and the libraries for them are large. If one of them crashes, hangs or is led astray by a file,
// only that program ends, and it could do little (file/landlock.h, no_network.h). Any thread; the
// caller waits.
#pragma once

#include <filesystem>

#include "sim/loaders/file/load_limits.h"
#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/reader/scene_request.h"

namespace scipd::sim {

/// Where scipd-read is: what SCIPD_READ names in the environment, or below the folder of this
/// program, or where it is installed. Throws LoadError that says where it was sought.
std::filesystem::path reader_program();

/// Sets what `limits` and this process have to say in `request`, and returns the scene that the
/// program reads. Throws LoadError: the one of the program, or one that begins with the request's
/// name and says that the program took too much time or memory, or crashed.
LoadedScene read_by(const std::filesystem::path& program, SceneRequest request,
                    const LoadLimits& limits);

}  // namespace scipd::sim
