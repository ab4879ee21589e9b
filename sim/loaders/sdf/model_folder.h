// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The folder of a model as Gazebo has it: model.config names its SDF files, one for each version.
// By hand, since libsdformat 12 crashes where it can read none of them. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scipd::sim {

/// The file of a model's folder with the highest version that we read, of newer ones the lowest;
/// empty where there is none. A file is itself. Adds to `warnings` where names differ in case.
std::filesystem::path model_file_of(const std::filesystem::path& path,
                                    std::vector<std::string>& warnings);

/// Empty where `model`, as model_file_of() found it in `path`, can be read.
std::string why_no_model(const std::filesystem::path& path, const std::filesystem::path& model);

/// Whether its model.config, or its package.xml, has this name for it, whatever it is called on
/// disk.
bool calls_itself(const std::filesystem::path& folder, const std::string& name);

}  // namespace scipd::sim
