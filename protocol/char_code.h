// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SCIP's numbers: groups of six bits, the most significant group first. Adding '0' makes a group a
// printable character.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scipd::protocol {

/// The largest number that fits into `width` characters and into 64 bits.
[[nodiscard]] constexpr std::uint64_t max_encoded(int width) {
    constexpr int widest = 10;
    return width > widest ? ~std::uint64_t{0} : (std::uint64_t{1} << (6 * width)) - 1;
}

/// Appends `value` as `width` characters (1 to 11); higher bits are lost.
constexpr void append_encoded(std::string& text, std::uint64_t value, int width) {
    for (int shift = 6 * (width - 1); shift >= 0; shift -= 6) {
        text.push_back(static_cast<char>(((value >> shift) & 0x3FU) + '0'));
    }
}

/// The number. Nothing: the text is empty, has a character outside '0' to 'o', or does not fit into
/// 64 bits.
[[nodiscard]] constexpr std::optional<std::uint64_t> decode(std::string_view text) {
    if (text.empty()) return std::nullopt;
    std::uint64_t value = 0;
    for (const char c : text) {
        const bool fits = value >> 58U == 0;
        if (c < '0' || c > 'o' || !fits) return std::nullopt;
        value = value << 6U | static_cast<std::uint64_t>(c - '0');
    }
    return value;
}

}  // namespace scipd::protocol
