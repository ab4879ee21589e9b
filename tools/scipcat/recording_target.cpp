// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/recording_target.h"

#include <filesystem>
#include <utility>

#include "daemon/recording/decoded_recording.h"
#include "sim/recording/recording_files.h"
#include "tools/options.h"

namespace scipd::tools {

bool is_recording(const std::string& target) {
    std::error_code error;
    const auto status = std::filesystem::status(sim::split_paths(target).front(), error);
    return std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status);
}

std::unique_ptr<sim::Recording> open_recorded(const std::string& target) {
    auto recording = daemon::open_scans(sim::split_paths(target));
    if (!recording) throw WrongInput(recording.error().why);
    return std::move(*recording);
}

}  // namespace scipd::tools
