// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the daemon's files go. Any thread, as long as nobody changes the environment.
#pragma once

#include <filesystem>

namespace scipd::daemon {

/// Where sockets and tty links go unless told otherwise: $RUNTIME_DIRECTORY, else
/// $XDG_RUNTIME_DIR/scipd, else /tmp/scipd-UID. Not created.
std::filesystem::path run_directory();

}  // namespace scipd::daemon
