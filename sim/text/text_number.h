// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Numbers in text, and the blanks between them. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sim/time.h"

namespace scipd::sim {

/// Stamps beyond this many seconds do not fit into nanoseconds of 64 bits (9.2e9 s).
inline constexpr double time_limit_s = 9e9;

/// The text without the blanks, tabs and line ends around it.
std::string_view trimmed(std::string_view text);

/// Reads a decimal number of units of 10^power seconds, exactly; digits beyond the nanosecond are
/// rounded. Nothing if the text is no number or lies beyond `time_limit_s`.
std::optional<Time> parse_stamp(std::string_view text, int power = 0);

/// The finite number that the whole text is; nothing if it is none. What is closer to 0 than any
/// double becomes the nearest of them.
std::optional<double> parse_number(std::string_view text);

/// Exactly `count` finite numbers, separated by blanks, each with or without a +; nothing if the
/// text is anything else.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

}  // namespace scipd::sim
