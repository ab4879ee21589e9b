// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Loads a robot or a world that is written in xacro, through the program of that name, if it is
// installed. Such a file can make the program do anything, so scipd runs it only for a file that
// the user names, never for a file that a world includes. Any thread; the caller waits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/loaders/file/loaded_scene.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// Lines in messages are lines of xacro's output. Throws LoadError as load_sdf() does, and also
/// with xacro's own complaint, or with what to install.
LoadedScene load_xacro(const std::filesystem::path& file, const SdfOptions& options = {});

/// A warning for each argument that neither the file nor one that it includes has; none where xacro
/// does not list these.
std::vector<std::string> ignored_arguments(const std::filesystem::path& file,
                                           const XacroArguments& arguments);

}  // namespace scipd::sim
