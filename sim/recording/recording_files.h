// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files of a recording, as users name them: files, and folders of rosbag2 or of a split bag.
// Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

using OpenFile = std::function<Expected<std::unique_ptr<Recording>>(const std::filesystem::path&)>;

/// Several files as one recording in order of time; streams of one name and one scanner are one
/// stream. In place of a folder come its files: those that metadata.yaml names, or bags. One of
/// those that is missing or cannot be read is left out with a warning.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_files(
    std::span<const std::filesystem::path> paths, const OpenFile& open_file);

/// "a.mcap+b.mcap": several files that an argument names as one recording. A file with a plus sign
/// in its name is itself.
[[nodiscard]] std::vector<std::filesystem::path> split_paths(std::string_view text);

}  // namespace scipd::sim
