// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A target that is the file of a recording. One thread.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/recording/values/recording.h"

namespace scipd::tools {

/// A scanner is no plain file. Folders count: what opens them says what to name.
[[nodiscard]] bool is_recording(const std::filesystem::path& target);

/// Its items are scans. Throws WrongInput if it cannot be read.
[[nodiscard]] std::unique_ptr<sim::Recording> open_recorded(const std::filesystem::path& target);

}  // namespace scipd::tools
