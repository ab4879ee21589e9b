// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes a recording of the format that the ending of its file names. Any thread; nothing shared.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "sim/recording/mcap/mcap_writer.h"
#include "sim/recording/values/recording.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim {

/// The endings that are known. .mcap alone keeps the conversation with the scanner.
inline constexpr std::array<std::string_view, 4> recording_endings = {".mcap", ".ubh", ".csv",
                                                                      ".jsonl"};

struct Recorder {
    std::string name;                                         ///< the program, as the file names it
    std::string version;                                      ///< of it
    mcap::Compression compression = mcap::Compression::zstd;  ///< of .mcap
};

/// Replaces an old file. Throws std::runtime_error where it cannot be written, and
/// std::invalid_argument for another ending.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_recording(const std::filesystem::path& path,
                                                                const ScannerIdentity& identity,
                                                                const Recorder& recorder);
/// Makes a recording as if the file's name had this ending.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_recording(const std::filesystem::path& path,
                                                                std::string_view ending,
                                                                const ScannerIdentity& identity,
                                                                const Recorder& recorder);

}  // namespace scipd::sim
