// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings in MCAP. Ours have, for each scanner, the conversation on /wire/to_scanner and
// /wire/from_scanner (encoding "scip": the bytes as they were) and its scans on /scan, as
// foxglove.LaserScan in JSON with members of our own (json/scan_json.h); a metadata record "scip"
// says which scanner it is (scanner_identity.h). Foxglove and Lichtblick show them. Read are also
// LaserScan and MultiEchoLaserScan of ROS 1 and 2, and foxglove.LaserScan in JSON of others. Any
// thread; nothing shared.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/mcap/mcap_writer.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {
namespace mcap {

// Names in our files. Behind a prefix such as /front, topics are of one scanner of several.
inline constexpr std::string_view to_scanner_topic = "/wire/to_scanner";
inline constexpr std::string_view from_scanner_topic = "/wire/from_scanner";
inline constexpr std::string_view scan_topic = "/scan";
inline constexpr std::string_view wire_encoding = "scip";
inline constexpr std::string_view metadata_name = "scip";
inline constexpr std::string_view scan_schema_name = "foxglove.LaserScan";

}  // namespace mcap

[[nodiscard]] Expected<std::unique_ptr<Recording>> open_mcap(InputFile file);

/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_mcap(const std::filesystem::path& path,
                                                           const ScannerIdentity& identity,
                                                           mcap::WriterOptions options);

}  // namespace scipd::sim
