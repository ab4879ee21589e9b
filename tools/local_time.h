// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <array>
#include <chrono>
#include <ctime>
#include <string>

namespace scipd::tools {

/// Text such as 2026-01-31 12:00:00, in the user's time zone, or in another format of strftime().
[[nodiscard]] inline std::string local_time(
    std::chrono::time_point<std::chrono::system_clock, std::chrono::nanoseconds> time,
    const char* format = "%F %T") {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(time);
    const std::time_t unix_s = seconds.time_since_epoch().count();
    std::tm local{};
    localtime_r(&unix_s, &local);
    std::array<char, 40> text{};
    std::strftime(text.data(), text.size(), format, &local);
    return text.data();
}

}  // namespace scipd::tools
