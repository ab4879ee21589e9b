// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A number from a name. Pure; any thread.
#pragma once

#include <cstdint>
#include <string_view>

namespace scipd::daemon {

/// FNV-1a: the same for the same name in every run, on every machine. What a sensor's chance is
/// derived from.
inline std::uint64_t stable_number(std::string_view name) {
    std::uint64_t number = 14695981039346656037ULL;
    for (const char c : name)
        number = (number ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return number;
}

}  // namespace scipd::daemon
