// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <filesystem>

namespace scipd::tools {

/// Prints what the recording holds, for people or as JSON. Throws WrongInput if it cannot be read.
void show_recording(const std::filesystem::path& file, bool json);

}  // namespace scipd::tools
