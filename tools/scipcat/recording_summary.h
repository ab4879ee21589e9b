// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a recording holds, told stream by stream once all of it has been read. Values; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recording.h"

namespace scipd::tools {

/// Where scans are missing: the time between two scans is more than one and a half times what it
/// mostly is.
struct RecordingGap {
    std::size_t after_scan = 0;  ///< counts from 1
    double seconds = 0;          ///< between that scan and the next
};

struct StreamSummary {
    sim::RecordedStream stream;
    std::size_t scans = 0;
    std::size_t steps = 0;  ///< of the longest scan
    double seconds = 0;     ///< from the first scan to the last, by the scanner's clock if there is
                            ///< one, else by the host's
    std::optional<sim::HostTime> begin;  ///< of the first scan
    std::size_t stamped = 0;             ///< scans whose time is the stamp in their header
    std::size_t logged = 0;              ///< scans whose time is that of the log
    bool intensities = false;            ///< in any scan
    bool echoes = false;
    bool codes = false;  ///< ranges are as the scanner sent them
    std::vector<RecordingGap> gaps;
};

struct RecordingSummary {
    std::string format;
    std::vector<StreamSummary> streams;
    std::vector<std::string> warnings;
};

/// Reads all of it. Its items are scans.
[[nodiscard]] sim::Expected<RecordingSummary> summarize(sim::Recording& recording);

}  // namespace scipd::tools
