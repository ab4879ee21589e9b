// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A number from a text: the hash FNV-1a (Fowler, Noll, Vo). The same text gives the same number in
// every run and on every machine, which std::hash does not promise. Chance for a sensor and short
// names are derived from it. Pure; any thread.
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

namespace scipd::sim {

/// In 32 or 64 bits.
template <typename Number>
    requires std::same_as<Number, std::uint32_t> || std::same_as<Number, std::uint64_t>
[[nodiscard]] constexpr Number fnv1a(std::string_view text) {
    constexpr bool wide = sizeof(Number) == sizeof(std::uint64_t);
    Number number = wide ? Number(14695981039346656037ULL) : Number(2166136261U);
    for (const char c : text)
        number =
            (number ^ static_cast<unsigned char>(c)) * Number(wide ? 1099511628211ULL : 16777619U);
    return number;
}

}  // namespace scipd::sim
