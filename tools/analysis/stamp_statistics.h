// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The rhythm of scans by the scanner's clock, and how fast that clock runs by the clock of the
// machine that received them. Functions of numbers; any thread.
#pragma once

#include <optional>
#include <span>

#include "tools/analysis/scan_table.h"

namespace scipd::tools {

/// How much faster than the host's clock, in millionths.
struct ClockRate {
    double ppm = 0;
    double uncertainty_ppm = 0;  ///< it hardly ever is farther off
};

/// Empty: the recording has no such times, or too few.
struct StampStatistics {
    std::optional<double> rate_hz;    ///< scans a second, gaps left out
    std::optional<double> jitter_ms;  ///< standard deviation of the time from scan to scan
    bool by_scanner = false;          ///< both are by its clock; else by the host's
    /// How much later than the earliest scans come after their stamps, in the mean.
    std::optional<double> delay_ms;
    std::optional<ClockRate> clock;
};

/// Stamps have whole ticks. Where the scans keep step with them, as at 25 ms, a clock is known to
/// about one and a half ticks over the time of the recording; where they do not, far better.
[[nodiscard]] StampStatistics stamp_statistics(std::span<const ScanTime> times, double tick_s);

/// Times of the host are since 1970.
struct ClockAnswer {
    double device_s = 0;  ///< in whole milliseconds
    double asked_s = 0;
    double answered_s = 0;
};

/// Time of the scanner's clock at one instant of the host's, the mean of the answers.
struct ClockReading {
    double device_s = 0;
    double host_s = 0;
    double deviation_s = 0;  ///< of the mean
    double took_s = 0;       ///< from question to answer, in the mean
    double soonest_s = 0;    ///< the same of the soonest answer
};

/// The scanner is taken to read its clock in the middle between question and answer. None of fewer
/// than four answers.
[[nodiscard]] std::optional<ClockReading> clock_reading(std::span<const ClockAnswer> answers);

/// An answer that took longer than the soonest waited before the scanner read its clock or after
/// it. Nobody knows which, so all of that counts as unknown.
[[nodiscard]] ClockRate rate_between(const ClockReading& before, const ClockReading& after);

}  // namespace scipd::tools
