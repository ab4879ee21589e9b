// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The files of a recording, as users name them: files, and folders of rosbag2 or of a split bag.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/expected.h"

namespace scipd::sim {

struct RecordingFile {
    std::filesystem::path path;
    bool named = true;    ///< by the user; else a folder has it
    std::string missing;  ///< a sentence, where the folder should have it
};

/// The files, with those of folders in place of the folders: in the order of metadata.yaml, or by
/// their names. The fault names the folder and what is wrong.
[[nodiscard]] Expected<std::vector<RecordingFile>> files_of(
    std::span<const std::filesystem::path> paths);

/// "a.mcap+b.mcap": several files that an argument names as one recording. A file with a plus sign
/// in its name is itself.
[[nodiscard]] std::vector<std::filesystem::path> split_paths(std::string_view text);

}  // namespace scipd::sim
