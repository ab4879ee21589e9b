// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A target that is a recording: a file, the folder of a bag, or several of them, as in
// "a.mcap+b.mcap". One thread.
#pragma once

#include <memory>
#include <string>

#include "sim/recording/values/recording.h"

namespace scipd::tools {

/// A scanner is no plain file and no folder.
[[nodiscard]] bool is_recording(const std::string& target);

/// Its items are scans. Throws WrongInput if it cannot be read.
[[nodiscard]] std::unique_ptr<sim::Recording> open_recorded(const std::string& target);

}  // namespace scipd::tools
