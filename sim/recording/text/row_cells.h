// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The cells of a table's row. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace scipd::sim {

/// Between semicolons, or commas, or blanks. So a comma within a number, as spreadsheets of some
/// countries write it, makes no two of it. An empty cell at the end is none.
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line);

/// Also as programs write what is no number. An empty cell is none.
[[nodiscard]] std::optional<double> number_in(std::string_view cell);

/// Without the mark of UTF-8 that some programs begin a file with, and without blanks around it.
[[nodiscard]] std::string_view row_in(std::string_view line);

/// Whether it is empty or a comment.
[[nodiscard]] inline bool is_no_row(std::string_view row) {
    return row.empty() || row.front() == '#';
}

}  // namespace scipd::sim
