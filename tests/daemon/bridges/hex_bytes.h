// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of tests as they are printed.
#pragma once

#include <string>
#include <string_view>

namespace scipd::tests {

/// Bytes from hexadecimal digits, with blanks between.
inline std::string hex_bytes(std::string_view digits) {
    std::string read;
    std::string pair;
    for (const char c : digits) {
        if (c == ' ') continue;
        pair += c;
        if (pair.size() < 2) continue;
        read += static_cast<char>(std::stoi(pair, nullptr, 16));
        pair.clear();
    }
    return read;
}

}  // namespace scipd::tests
