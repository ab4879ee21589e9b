// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The name above a column, taken apart. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scipd::sim {

struct ColumnTitle {
    std::string stem;              ///< in small letters, such as "field.ranges" of field.ranges12
    std::optional<double> number;  ///< that it ends in, such as -1.5 of angle_-1.5 and of -1.5

    [[nodiscard]] static ColumnTitle of(std::string_view name);

    /// Whether the stem has it anywhere.
    [[nodiscard]] bool has(std::string_view part) const { return stem.find(part) != stem.npos; }
    /// Whether it has it as a word, with no letter beside it.
    [[nodiscard]] bool has_word(std::string_view word) const;
};

}  // namespace scipd::sim
