// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a twin is made of: recordings of a scanner that stands, and, where a person is there to turn
// it, of one that stands turned. One thread.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/scipcat/scan_options.h"

namespace scipd::tools {

/// Records so many seconds each time, in files of the folder. With intensities if the scanner sends
/// any. On a terminal it asks for what it needs, and nothing elsewhere. Throws
/// protocol::client::Error; and std::runtime_error where the user interrupts it, which leaves
/// recordings that are whole.
[[nodiscard]] std::vector<std::filesystem::path> record_for_twin(
    const ConnectionOptions& connection, double seconds, const std::filesystem::path& folder);

}  // namespace scipd::tools
