// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner's clock says, from many answers to the question for its time, and how fast it runs
// from one reading to another. Functions of numbers; any thread.
#pragma once

#include <optional>
#include <span>

#include "tools/analysis/stamp_statistics.h"

namespace scipd::tools {

/// Times of the host are since 1970.
struct ClockAnswer {
    double device_s = 0;  ///< in whole milliseconds
    double asked_s = 0;
    double answered_s = 0;
};

/// What the clock said at one moment of ours, in the mean of the answers.
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
