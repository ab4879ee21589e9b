// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// JSON lines: an object a scan, complete in itself. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"
#include "sim/recording/values/recording_writer.h"

namespace scipd::sim {

/// Scanners of different serial numbers are streams of their own.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_json_lines(InputFile file);

/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_json_lines(const std::filesystem::path& path,
                                                                 ScannerIdentity identity);

}  // namespace scipd::sim
