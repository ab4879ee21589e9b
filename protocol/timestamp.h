// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The device's clock as the wire shows it: milliseconds in 24 bits, which wrap after 4 hours 39
// minutes 37 seconds.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "protocol/char_code.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

inline constexpr int timestamp_width = 4;

/// `zero` is the instant at which the counter is 0: power-up or RS, for example. Before that
/// instant the counter shows the end of its range.
[[nodiscard]] constexpr std::uint32_t timestamp_ms(Uptime now, Uptime zero) {
    const auto ms = std::chrono::floor<std::chrono::milliseconds>(now - zero).count();
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(ms) &
                                      max_encoded(timestamp_width));
}

[[nodiscard]] constexpr std::string encoded_timestamp(Uptime now, Uptime zero) {
    std::string text;
    append_encoded(text, timestamp_ms(now, zero), timestamp_width);
    return text;
}

/// The clock of the newest firmware: microseconds in 64 bits, which do not wrap.
inline constexpr int microsecond_stamp_width = 11;
[[nodiscard]] constexpr std::string encoded_microseconds(Uptime now, Uptime zero) {
    const auto us = std::chrono::floor<std::chrono::microseconds>(now - zero).count();
    std::string text;
    append_encoded(text, static_cast<std::uint64_t>(us), microsecond_stamp_width);
    return text;
}

/// Six upper-case hexadecimal digits, as the II reply of the URG-04LX and the UTM-30LX spells it.
[[nodiscard]] std::string hexadecimal_timestamp(Uptime now, Uptime zero);

}  // namespace scipd::protocol
