// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/text/table_look.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "sim/recording/text/row_cells.h"
#include "sim/recording/values/range_unit.h"

namespace scipd::sim {
namespace {

using Cells = std::vector<std::string_view>;

/// The cells of the next row; none at the end. `text` goes on behind it.
Cells take_row(std::string_view& text) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (const std::string_view row = row_in(line); !is_no_row(row)) return cells_of(row);
    }
    return {};
}

/// NaN in place of what is no number.
std::vector<double> numbers_in(const Cells& cells) {
    std::vector<double> numbers;
    for (const std::string_view cell : cells)
        numbers.push_back(number_in(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
    return numbers;
}

bool has_letters(std::string_view cell) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_[\"";
    return !number_in(cell) && cell.find_first_of(letters) != cell.npos;
}

/// Numbers that go up evenly are of steps or angles, unless those of the next row do as well.
std::optional<Expected<TableColumns>> header_in(const Cells& first, const Cells& second) {
    if (std::ranges::any_of(first, has_letters)) return columns_named(first);
    // pandas writes its index in front, under no name.
    if (first.size() > 1 && first.front().empty()) {
        const auto behind = numbers_in({first.begin() + 1, first.end()});
        if (columns_numbered(behind)) return columns_named(first);
    }
    auto numbered = columns_numbered(numbers_in(first));
    if (!numbered || second.empty() || columns_numbered(numbers_in(second))) return std::nullopt;
    return *std::move(numbered);
}

void show(const Cells& row, TableColumns::Block ranges, LikelyUnit& unit) {
    const std::size_t end = std::min(ranges.first + ranges.count, row.size());
    for (std::size_t column = ranges.first; column < end; ++column) {
        const bool point = row[column].find_first_of(".eE") != std::string_view::npos;
        if (const auto range = number_in(row[column])) unit.show(*range, point);
    }
}

}  // namespace

TableLook look_at_table(std::string_view text) {
    const Cells first = take_row(text);
    std::string_view rest = text;
    const Cells second = take_row(rest);
    TableLook look{.header = header_in(first, second)};
    const bool known = look.header && *look.header;
    const auto ranges = known ? (**look.header).ranges : TableColumns::Block{0, first.size()};
    if (known && (**look.header).unit) {
        look.unit = *(**look.header).unit;
        return look;
    }
    LikelyUnit unit;
    if (!look.header) show(first, ranges, unit);
    for (Cells row = take_row(text); !row.empty(); row = take_row(text))
        show(row, ranges, unit);
    look.unit = unit.unit();
    return look;
}

}  // namespace scipd::sim
