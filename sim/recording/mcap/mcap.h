// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings in MCAP. Ours have, for each scanner, the conversation on /wire/to_scanner and
// /wire/from_scanner (encoding "scip": the bytes as they were) and its scans on /scan, as
// foxglove.LaserScan in JSON with members of our own (json/scan_json.h); a metadata record "scip"
// says which scanner it is (identity_entries.h). Foxglove and Lichtblick show them. Read are also
// LaserScan and MultiEchoLaserScan of ROS 1 and 2, and foxglove.LaserScan in JSON of others. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sim/recording/file/input_file.h"
#include "sim/recording/mcap/mcap_writer.h"
#include "sim/recording/values/recording.h"
#include "sim/recording/values/recording_writer.h"

namespace scipd::sim {

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_mcap(InputFile file);

/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_mcap(const std::filesystem::path& path,
                                                           const ScannerIdentity& identity,
                                                           mcap::WriterOptions options);

}  // namespace scipd::sim
