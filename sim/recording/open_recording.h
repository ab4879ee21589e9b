// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Opens a recording of any format. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/expected.h"
#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// The content tells the format: MCAP, bags of ROS 1 and 2, UBH, CSV, JSON lines, logs of CARMEN
/// and Player, NumPy arrays and captures of a network. The ending counts where the beginning of a
/// text leaves it open. The fault names the file and says what to do.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(
    const std::filesystem::path& path);
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(InputFile file);

}  // namespace scipd::sim
