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

/// Without the blanks, tabs and line ends around it.
std::string_view trimmed(std::string_view text);

/// Decimals, exactly, of units of 10^power seconds; digits past the nanosecond are rounded into it.
/// Nothing where it is no number or beyond the limit.
std::optional<Time> parse_stamp(std::string_view text, int power = 0);

/// All of it, and finite.
std::optional<double> parse_number(std::string_view text);

/// That many between blanks, each finite, with or without a +; nothing where the text is otherwise.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

}  // namespace scipd::sim
