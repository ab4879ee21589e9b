// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A row of a table and the scan in it. All tables and logs of a scan a row are read here, each by
// its description: CSV, tables of numbers, and the logs of CARMEN, Player and CoreSLAM.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"

namespace scipd::sim::table {

using Cells = std::vector<std::string_view>;

/// The row's own separator: a semicolon if it has one, else a comma, else blanks. A decimal comma
/// between semicolons splits no cell.
inline constexpr char any_separator = '\0';

/// Cells without blanks around them. An empty one at the end counts only if the row has `wanted`
/// cells with it.
[[nodiscard]] Cells cells_of(std::string_view row, char separator = any_separator,
                             std::size_t wanted = 0);

/// True for blanks alone, and for a comment.
[[nodiscard]] bool is_no_row(std::string_view line);

/// A number, an infinity or NaN, as programs write them. NaN for an empty cell.
[[nodiscard]] std::optional<double> number_in(std::string_view cell);

/// Index of a column. Negative ones count from the end of the row; -1 is the last.
using Column = std::optional<int>;

/// The finite number in the column, or so many columns behind it.
[[nodiscard]] std::optional<double> finite_at(const Cells& cells, Column column,
                                              std::size_t behind = 0);

/// Columns with one value for the whole scan.
struct Columns {
    Column host_time = {};  ///< Unix time; its size shows whether it is in s, ms, µs or ns
    Column stamp_ms = {};
    Column stamp_us = {};
    Column first_rad = {};
    Column increment_rad = {};
    Column pose = {};  ///< x in m; y in m and yaw in rad are behind it
};

/// Columns with a value for each step: the ranges or the intensities of one echo.
struct Block {
    std::size_t first = 0;
    std::size_t steps = 0;
    std::size_t stride = 1;
    bool intensities = false;
};

struct Description {
    Columns columns;
    std::vector<Block> blocks;  ///< of the same steps; at least one
    RecordedScan blank;         ///< unit and directions of all rows
    bool echoes = false;        ///< an empty cell: the step has no such echo
};

/// A value that is no number is left out. The blocks must be within the row; the error is the index
/// of a cell in them that is no number.
[[nodiscard]] tl::expected<RecordedScan, std::size_t> scan_of(const Cells& cells,
                                                              const Description& description);

}  // namespace scipd::sim::table
