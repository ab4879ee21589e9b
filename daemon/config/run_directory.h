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

/// The control socket where the user names none.
std::filesystem::path usual_control_socket();

/// Makes the run directory, and returns it. Throws std::runtime_error.
std::filesystem::path make_run_directory();

/// Makes the folder, for this user alone, where it is not there yet. Throws std::runtime_error.
void make_folder(const std::filesystem::path& folder);

/// As make_folder(), and a folder that is there already must be for this user alone, too.
void make_private_folder(const std::filesystem::path& folder);

}  // namespace scipd::daemon
