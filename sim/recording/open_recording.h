// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Opens a recording of any format. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "sim/expected.h"
#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// The content tells the format: MCAP, bags of ROS 1 and 2, UBH, CSV, JSON lines, logs of CARMEN
/// and Player, NumPy arrays and captures of a network, also packed by Zstandard. The ending counts
/// where the beginning of a text leaves it open. A folder is the recording of the bags in it. The
/// fault names the file and says what to do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(
    const std::filesystem::path& path);
/// Several files or folders are one recording, in order of time.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(
    std::span<const std::filesystem::path> paths);
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(InputFile file);

}  // namespace scipd::sim
