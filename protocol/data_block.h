// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The part of a reply that holds the measured values: all of them as one string of characters, cut
// into lines of 64 with a checksum each. A cut may go through a value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scipd::protocol {

inline constexpr std::size_t data_line_length = 64;

/// Appends the values, each as `width` characters (2 or 3) and none larger than those can hold.
void append_data_block(std::string& message, std::span<const std::uint32_t> values, int width);

/// Appends values that are encoded already.
void append_data_block(std::string& message, std::string_view characters);

/// How many characters append_data_block() appends.
[[nodiscard]] constexpr std::size_t data_block_size(std::size_t values, int width) {
    const std::size_t characters = values * static_cast<std::size_t>(width);
    const std::size_t lines = (characters + data_line_length - 1) / data_line_length;
    return characters + 2 * lines;
}

}  // namespace scipd::protocol
