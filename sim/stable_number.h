// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A number made from a name. Pure; any thread.
#pragma once

#include <cstdint>
#include <string_view>

namespace scipd::sim {

/// FNV-1a: the same name gives the same number in every run, on every machine. A sensor's chance is
/// derived from it.
inline std::uint64_t stable_number(std::string_view name) {
    std::uint64_t number = 14695981039346656037ULL;
    for (const char c : name)
        number = (number ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return number;
}

}  // namespace scipd::sim
