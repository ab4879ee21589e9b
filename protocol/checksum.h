// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <string_view>

namespace scipd::protocol {

/// The character that ends every line of a reply but the echo: the low six bits of the sum of all
/// characters before it, made printable by adding '0' (SCIP 2.0 specification C-42-03320B).
[[nodiscard]] constexpr char checksum(std::string_view line) {
    unsigned sum = 0;
    for (const char c : line)
        sum += static_cast<unsigned char>(c);
    return static_cast<char>((sum & 0x3FU) + '0');
}

}  // namespace scipd::protocol
