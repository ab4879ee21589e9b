// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the channels and the metadata of our MCAP files are called. Behind a prefix such as /front,
// they are of one scanner of several. Values; no thread rule.
#pragma once

#include <string_view>

namespace scipd::sim::mcap {

inline constexpr std::string_view to_scanner_topic = "/wire/to_scanner";
inline constexpr std::string_view from_scanner_topic = "/wire/from_scanner";
inline constexpr std::string_view scan_topic = "/scan";
inline constexpr std::string_view wire_encoding = "scip";
inline constexpr std::string_view metadata_name = "scip";
inline constexpr std::string_view scan_schema_name = "foxglove.LaserScan";

/// JSON Schema of the scans: foxglove.LaserScan, and beside it what it has no room for.
extern const std::string_view scan_schema;

}  // namespace scipd::sim::mcap
