// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scenes out of a child process, in which libraries may do what they will with files from anywhere,
// and which ends at once where nobody waits for it any more. Any thread; the caller waits.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>

#include "sim/loaders/file/loaded_scene.h"

namespace scipd::sim {

struct LoadLimits {
    std::size_t memory_bytes = std::size_t{16} << 30U;
    std::chrono::seconds wall_time = std::chrono::minutes{10};
    std::stop_token stop = {};
};

/// What `load` answers with in the child. Throws LoadError: what `load` threw, or that it took too
/// much or crashed, in which `name` says what was loaded.
LoadedScene load_confined(const std::string& name, const LoadLimits& limits,
                          const std::function<LoadedScene()>& load);

}  // namespace scipd::sim
