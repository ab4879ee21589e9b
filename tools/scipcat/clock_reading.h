// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner's clock against ours, by asking it for its time again and again. One thread.
#pragma once

#include <optional>

#include "protocol/client/driver.h"
#include "tools/statistics/stamp_statistics.h"

namespace scipd::tools {

/// What its clock said at one moment of ours, in the mean of many answers.
struct ClockReading {
    double device_s = 0;
    double host_s = 0;  ///< since 1970
    double deviation_s = 0;
};

/// Asks about forty times, within half a second. None if the scanner does not answer. The laser
/// is off meanwhile, and the stream stands still.
[[nodiscard]] std::optional<ClockReading> read_clock(protocol::client::Driver& driver);

/// Between two readings.
[[nodiscard]] ClockRate rate_between(const ClockReading& before, const ClockReading& after);

}  // namespace scipd::tools
