// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The folder of a Gazebo model, whose model.config names one SDF file for each version of SDF. Any
// thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/expected.h"

namespace scipd::sim {

/// The SDF file in a model's folder with the highest version that scipd reads. If all are newer,
/// the one with the lowest version. Empty if there is none. If `path` is a file, returns it. Adds
/// to `warnings` if names differ in case.
std::filesystem::path model_file_of(const std::filesystem::path& path,
                                    std::vector<std::string>& warnings);

/// Whether `model`, which model_file_of() found in `path`, can be read.
[[nodiscard]] Expected<> check_model(const std::filesystem::path& path,
                                     const std::filesystem::path& model);

/// True if the folder has a model.config, or a manifest.xml, its former name.
bool is_model_folder(const std::filesystem::path& folder);

/// Whether the model.config or package.xml of a folder gives it this name. The folder's own name
/// does not matter.
bool calls_itself(const std::filesystem::path& folder, const std::string& name);

/// The name that the package.xml of a folder gives it; empty if there is none.
std::string package_name(const std::filesystem::path& folder);

}  // namespace scipd::sim
