// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A robot or a world that is written in xacro, through the program of that name, where it is
// installed. Such a file can make the program do anything; so it is for the file that somebody
// names, and for none that a world includes. Any thread; the caller waits.
#pragma once

#include <filesystem>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// Lines in messages are those of what xacro prints. Throws LoadError: as load_sdf(), with what
/// xacro has against the file, or saying what to install.
LoadedScene load_xacro(const std::filesystem::path& file, const SdfOptions& options = {});

}  // namespace scipd::sim
