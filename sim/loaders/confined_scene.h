// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a scene in a child process: if a library crashes or hangs on a file from outside, only the
// child ends. The child ends at once if nobody waits for it any more. Any thread; the caller waits.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/loaded_scene.h"

namespace scipd::sim {

struct LoadLimits {
    std::size_t memory_bytes = std::size_t{16} << 30U;
    std::chrono::seconds wall_time = std::chrono::minutes{10};
    std::stop_token stop = {};
    std::optional<Folders> folders = {};  ///< nothing is read elsewhere; without: anything is
};

/// Runs `load` in the child and returns its scene. Throws LoadError: the one that `load` threw, or
/// one that begins with `name` and says that `load` took too much time or memory, or crashed.
LoadedScene load_confined(const std::string& name, const LoadLimits& limits,
                          const std::function<LoadedScene()>& load);

}  // namespace scipd::sim
