// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Records the scans of a scanner in a file. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/recording/create_recording.h"
#include "tools/scipcat/scan_options.h"

namespace scipd::tools {

/// How long to record: as long as all of this lets it.
struct RecordLimits {
    std::uint64_t scans = 0;        ///< 0: any number
    std::optional<double> seconds;  ///< from the first scan on
};

struct Recorded {
    std::uint64_t scans = 0;
    std::size_t damaged = 0;  ///< scans that arrived damaged and were dropped
    bool interrupted = false;
};

/// Ends with the limits, or when the user has enough; the file is whole then, as it is where an
/// error is thrown later. `before`: what stands before the number of scans on a terminal. Throws
/// protocol::client::Error, and std::runtime_error where the file cannot be written.
Recorded record_scans(const ConnectionOptions& connection, const ScanOptions& scan,
                      const RecordLimits& limits, const std::string& file,
                      sim::mcap::Compression compression, const std::string& before = {});

}  // namespace scipd::tools
