// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Times and numbers as the text formats write them. Any thread; nothing shared.
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "sim/recording/text/word_line.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/text/text_number.h"

namespace scipd::sim {

/// Seconds since 1970, with microseconds.
[[nodiscard]] inline std::string seconds_text(HostTime time) {
    const auto since_1970 = time.time_since_epoch();
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
    char text[40];
    std::snprintf(text, sizeof text, "%lld.%06lld", static_cast<long long>(us / 1000000),
                  static_cast<long long>(us % 1000000));
    return text;
}

/// The time of such seconds; nothing if the text is no number.
[[nodiscard]] inline std::optional<HostTime> host_time_in(std::string_view seconds) {
    const auto time = parse_stamp(seconds);
    if (!time) return std::nullopt;
    return HostTime(*time);
}

/// The pose that the next three words are; nothing if one of them is no number, as where a program
/// did not know the place.
[[nodiscard]] inline std::optional<LaserPose> pose_in(WordLine words) {
    const LaserPose pose{words.number(), words.number(), words.number()};
    return words.wrong() ? std::nullopt : std::optional(pose);
}

/// A whole number as text, without a point.
[[nodiscard]] inline std::string whole_text(double value) {
    return std::to_string(std::llround(value));
}

}  // namespace scipd::sim
