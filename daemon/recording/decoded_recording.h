// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Opens a recording of any format for its scans: those that are in it as scans, and those in the
// conversations that it has. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recording.h"

namespace scipd::daemon {

/// As sim::open_recording(), but all items are scans, and connections on which nobody spoke SCIP
/// are no streams. A warning says where a stream's times go back.
[[nodiscard]] sim::Expected<std::unique_ptr<sim::Recording>> open_scans(
    const std::vector<std::filesystem::path>& paths);
[[nodiscard]] std::unique_ptr<sim::Recording> scans_of(std::unique_ptr<sim::Recording> recording);

}  // namespace scipd::daemon
