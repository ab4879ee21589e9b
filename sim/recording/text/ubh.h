// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// UBH, the log of the maker's UrgBenri: each key in brackets and each value has a line of its own,
// and the values of a scan stand between semicolons, as mm, mm|intensity or, echo after echo,
// mm&mm. Any thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sim/recording/file/input_file.h"
#include "sim/recording/values/recording.h"
#include "sim/recording/values/recording_writer.h"

namespace scipd::sim {

/// Times are taken for local time, in which UrgBenri writes them.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_ubh(InputFile file);

/// `recorder` is the program with its version. Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_ubh(const std::filesystem::path& path,
                                                          ScannerIdentity identity,
                                                          std::string recorder);

}  // namespace scipd::sim
