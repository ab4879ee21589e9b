// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scipd that was killed has left in the run directory under names of its own, with its
// process number: control-4711.sock, robot-scanner-4711 and the locks beside them. What has the
// usual names the next scipd takes over by itself. Waits for nothing; one thread.
#pragma once

#include <filesystem>

namespace scipd::daemon {

/// Removes those whose process is gone and that nobody holds (path_hold). Leaves all else, and what
/// it cannot remove.
void remove_leftovers(const std::filesystem::path& run_directory);

}  // namespace scipd::daemon
