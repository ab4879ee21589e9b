// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// CSV: comments that say whose scans they are and explain the columns, then a row a scan, of
// numbers only, which numpy.loadtxt and gnuplot read without options. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"
#include "sim/recording/values/recording_writer.h"

namespace scipd::sim {

/// Reads what create_csv() and the live page write. Refuses other tables.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_csv(InputFile file);

/// `recorder` is the program, for the first comment. All scans must look where the first one looks:
/// another throws std::invalid_argument. With echoes a cell is empty if the step has no such echo.
/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_csv(const std::filesystem::path& path,
                                                          ScannerIdentity identity,
                                                          std::string recorder);

}  // namespace scipd::sim
