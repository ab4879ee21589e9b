// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Has the kernel hold a program to folders, since the program opens files by itself (Landlock, from
// Linux 5.13 on). For a child process that is about to become the program.
#pragma once

#include "sim/loaders/file/allowed_folder.h"

namespace scipd::sim {

/// From now on this process writes no file, and reads only what lies in these folders and what
/// programs of the PATH are made of. A folder may be a file, which is read then. False: the kernel
/// cannot do that, and nothing has changed.
[[nodiscard]] bool hold_program_to(const Folders& folders);

}  // namespace scipd::sim
